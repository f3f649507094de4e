//! Mesh files and hulls: every format gives the same cube, every way of being broken is refused with its place.

use std::fs;
use std::path::{Path, PathBuf};

use gyration::shape::{Polyhedron, PolyhedronError};
use gyration::tensor::Vec3;
use gyration_geometry::{FilePlace, MAX_MESH_BYTES, MeshError, Trouble, parse_mesh, read_mesh};
use tempfile::TempDir;

/// Faces of the unit cube [0,1]³, corners by the bits of x, y, z; counter-clockwise from outside.
const FACES: [[usize; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn corner(index: usize) -> [f64; 3] {
    [(index & 1) as f64, (index >> 1 & 1) as f64, (index >> 2 & 1) as f64]
}

fn triangles() -> Vec<[usize; 3]> {
    FACES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

fn text_stl(triangles: &[[usize; 3]]) -> String {
    let mut text = String::from("solid\n");
    for triangle in triangles {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for [x, y, z] in triangle.map(corner) {
            text += &format!("      vertex {x} {y} {z}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid\n"
}

fn binary_stl(triangles: &[[usize; 3]], header: &str) -> Vec<u8> {
    let mut bytes = format!("{header:80}").into_bytes();
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        let values = triangle.iter().flat_map(|&index| corner(index));
        bytes.extend(values.flat_map(|value| (value as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn obj(faces: &[Vec<usize>]) -> String {
    let mut text = String::from("# a cube\no cube\n");
    for [x, y, z] in (0..8).map(corner) {
        text += &format!("v {x} {y} {z}\n");
    }
    for face in faces {
        let words: Vec<String> = face.iter().map(|index| format!("{}/1/1", index + 1)).collect();
        text += &format!("f {}\n", words.join(" "));
    }
    text
}

fn quads() -> Vec<Vec<usize>> {
    FACES.iter().map(|face| face.to_vec()).collect()
}

fn ply_header(format: &str, vertices: u64, faces: u64) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a cube\nelement vertex {vertices}\nproperty float x\nproperty double y\n\
         property uchar red\nproperty float z\nelement face {faces}\nproperty list uchar int vertex_indices\n\
         property float quality\nelement edge 1\nproperty list uint short loop\nend_header\n"
    )
}

fn text_ply() -> String {
    let mut text = ply_header("ascii", 8, 6);
    for [x, y, z] in (0..8).map(corner) {
        text += &format!("{x} {y} 255 {z}\n");
    }
    for [a, b, c, d] in FACES {
        text += &format!("4 {a} {b} {c} {d} 0.5\n");
    }
    text + "3 1 2 3"
}

fn binary_ply(is_big_endian: bool) -> Vec<u8> {
    let format = if is_big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = ply_header(format, 8, 6).into_bytes();
    let mut put = |little: &[u8]| {
        let mut value = little.to_vec();
        if is_big_endian {
            value.reverse();
        }
        bytes.extend(value);
    };
    for [x, y, z] in (0..8).map(corner) {
        put(&(x as f32).to_le_bytes());
        put(&y.to_le_bytes());
        put(&[255]);
        put(&(z as f32).to_le_bytes());
    }
    for face in FACES {
        put(&[4]);
        face.iter().for_each(|&index| put(&(index as i32).to_le_bytes()));
        put(&0.5_f32.to_le_bytes());
    }
    put(&2_u32.to_le_bytes());
    put(&1_i16.to_le_bytes());
    put(&2_i16.to_le_bytes());
    bytes
}

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn read(&self, name: &str, content: impl AsRef<[u8]>) -> Result<Polyhedron, MeshError> {
        fs::write(self.path(name), content).unwrap();
        read_mesh(&self.path(name), 1.0)
    }

    fn fault(&self, name: &str, content: impl AsRef<[u8]>) -> (FilePlace, Trouble) {
        match self.read(name, content) {
            Err(MeshError::Malformed { fault, .. }) => (fault.place, fault.trouble),
            other => panic!("{name}: expected a malformed file, got {other:?}"),
        }
    }

    fn not_a_body(&self, name: &str, content: impl AsRef<[u8]>) -> PolyhedronError {
        match self.read(name, content) {
            Err(MeshError::NotABody { fault, .. }) => fault,
            other => panic!("{name}: expected triangles that bound nothing, got {other:?}"),
        }
    }
}

fn assert_is_unit_cube(name: &str, cube: &Polyhedron) {
    let mass = cube.mass_properties(1.0);
    assert_eq!((cube.vertices.len(), cube.triangles.len()), (8, 12), "{name}");
    // Corners are exact in f32; what remains is rounding of twelve sums.
    assert!((mass.volume - 1.0).abs() < 1e-15, "{name}: {}", mass.volume);
    assert!((mass.center - Vec3::repeat(0.5)).norm() < 1e-15, "{name}: {}", mass.center);
}

#[test]
fn every_format_gives_the_same_cube() {
    let folder = Folder::new();
    let files: [(&str, Vec<u8>); 8] = [
        ("text.stl", text_stl(&triangles()).into()),
        ("upper.STL", text_stl(&triangles()).to_uppercase().into()),
        ("binary.stl", binary_stl(&triangles(), "made by a test")),
        ("misleading.stl", binary_stl(&triangles(), "solid but binary")),
        ("quads.obj", obj(&quads()).into()),
        ("text.ply", text_ply().into()),
        ("little.ply", binary_ply(false)),
        ("big.ply", binary_ply(true)),
    ];
    for (name, content) in files {
        assert_is_unit_cube(name, &folder.read(name, content).unwrap_or_else(|error| panic!("{error}")));
    }
}

#[test]
fn line_ends_of_other_systems_are_read() {
    let folder = Folder::new();
    for (name, text) in [("a.stl", text_stl(&triangles())), ("a.obj", obj(&quads())), ("a.ply", text_ply())] {
        assert_is_unit_cube(name, &folder.read(name, text.replace('\n', "\r\n")).unwrap());
    }
}

#[test]
fn scale_multiplies_coordinates() {
    let folder = Folder::new();
    folder.read("a.obj", obj(&quads())).unwrap();
    let volume = read_mesh(&folder.path("a.obj"), 1e-3).unwrap().mass_properties(1.0).volume;
    assert!((volume - 1e-9).abs() < 1e-24, "{volume}");
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(read_mesh(&folder.path("a.obj"), scale), Err(MeshError::Scale { .. })), "{scale}");
    }
}

#[test]
fn text_keeps_double_precision() {
    let folder = Folder::new();
    let text = text_stl(&triangles()).replace("vertex 1 ", "vertex 1.0000000001 ");
    let volume = folder.read("a.stl", text).unwrap().mass_properties(1.0).volume;
    assert!((volume - 1.0000000001).abs() < 1e-15, "{volume}");
}

#[test]
fn an_obj_of_other_editors_is_read() {
    let text = obj(&quads());
    let marked = format!("\u{feff}{text}");
    assert_is_unit_cube("a.obj", &Folder::new().read("a.obj", marked).unwrap());
    // Each line of a face in two, the second with blanks before it.
    let continued: Vec<String> = text
        .lines()
        .map(|line| if line.starts_with('f') { line.replacen(' ', " \\\r\n   ", 2) } else { line.to_owned() })
        .collect();
    assert_is_unit_cube("a.obj", &Folder::new().read("a.obj", continued.join("\n")).unwrap());
}

#[test]
fn relative_indices_of_obj_count_from_the_end() {
    let folder = Folder::new();
    let faces: String = quads()
        .iter()
        .map(|f| format!("f {} {} {} {}\n", f[0] as i64 - 8, f[1] as i64 - 8, f[2] as i64 - 8, f[3] as i64 - 8))
        .collect();
    let text = obj(&[]) + &faces;
    assert_is_unit_cube("a.obj", &folder.read("a.obj", text).unwrap());
}

#[test]
fn quadrilateral_with_a_dent_is_split_within_itself() {
    // An arrowhead prism: area ½·2·2 − ½·2·1 = 1, height 1; its fan must start at the dent or at the tip.
    let outline = [[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, 2.0]];
    let mut text = String::new();
    for z in [0.0, 1.0] {
        for [x, y] in outline {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text += "f 1 4 3 2\nf 5 6 7 8\n";
    for k in 0..4 {
        let next = (k + 1) % 4;
        text += &format!("f {} {} {} {}\n", k + 1, next + 1, next + 5, k + 5);
    }
    let folder = Folder::new();
    let prism = folder.read("a.obj", text).unwrap();
    assert!((prism.mass_properties(1.0).volume - 1.0).abs() < 1e-15);
    // Two ends of area 1, two long sides √5, two short ones √2: more if triangles overlapped.
    let area = 2.0 + 2.0 * 5.0_f64.sqrt() + 2.0 * 2.0_f64.sqrt();
    assert!((prism.area() - area).abs() < 1e-14, "{} {area}", prism.area());
}

#[test]
fn polygon_without_a_fan_is_refused() {
    let comb =
        "v 0 0 0\nv 5 0 0\nv 5 2 0\nv 4 2 0\nv 4 1 0\nv 3 1 0\nv 3 2 0\nv 2 2 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
    let face = format!("f {}\n", (1..=12).map(|k| k.to_string()).collect::<Vec<_>>().join(" "));
    let (place, trouble) = Folder::new().fault("a.obj", format!("{comb}{face}"));
    assert_eq!((place, trouble), (FilePlace::Line(13), Trouble::Polygon { corners: 12 }));
}

#[test]
fn vertices_of_no_face_are_left_out() {
    let cube = Folder::new().read("a.obj", format!("v 9 9 9\n{}", obj(&[])) + &quads_from(1)).unwrap();
    assert_is_unit_cube("a.obj", &cube);
}

fn quads_from(first: usize) -> String {
    quads()
        .iter()
        .map(|f| format!("f {} {} {} {}\n", f[0] + first + 1, f[1] + first + 1, f[2] + first + 1, f[3] + first + 1))
        .collect()
}

#[test]
fn missing_and_foreign_files_are_refused() {
    let folder = Folder::new();
    let missing = read_mesh(&folder.path("missing.stl"), 1.0).unwrap_err();
    assert!(matches!(missing, MeshError::Unreadable { .. }), "{missing}");
    assert!(missing.to_string().contains("missing.stl"), "{missing}");
    assert!(matches!(folder.read("a.step", ""), Err(MeshError::UnknownFormat { .. })));
    fs::create_dir(folder.path("folder.stl")).unwrap();
    assert!(matches!(read_mesh(&folder.path("folder.stl"), 1.0), Err(MeshError::Unreadable { .. })));
}

#[test]
fn huge_file_is_refused_unread() {
    let folder = Folder::new();
    let file = fs::File::create(folder.path("a.stl")).unwrap();
    file.set_len(MAX_MESH_BYTES + 1).unwrap();
    let error = read_mesh(&folder.path("a.stl"), 1.0).unwrap_err();
    assert!(matches!(error, MeshError::TooLarge { .. }), "{error}");
}

#[test]
fn empty_files_are_refused() {
    let folder = Folder::new();
    assert!(matches!(folder.fault("a.stl", "").1, Trouble::Truncated { .. }));
    assert!(matches!(folder.fault("a.ply", "").1, Trouble::Truncated { .. }));
    assert!(matches!(folder.read("a.obj", ""), Err(MeshError::Empty { .. })));
    assert!(matches!(folder.read("b.stl", "solid\nendsolid\n"), Err(MeshError::Empty { .. })));
    assert!(matches!(folder.read("c.stl", binary_stl(&[], "")), Err(MeshError::Empty { .. })));
}

#[test]
fn truncated_files_are_refused_at_every_length() {
    let folder = Folder::new();
    let files: [(&str, Vec<u8>); 5] = [
        ("text.stl", text_stl(&triangles()).trim_end().into()),
        ("binary.stl", binary_stl(&triangles(), "")),
        ("text.ply", text_ply().into()),
        ("little.ply", binary_ply(false)),
        ("big.ply", binary_ply(true)),
    ];
    for (name, content) in files {
        for length in 0..content.len() {
            let result = folder.read(name, &content[..length]);
            assert!(matches!(result, Err(MeshError::Malformed { .. })), "{name} {length}: {result:?}");
        }
    }
}

#[test]
fn announced_counts_beyond_the_file_are_refused() {
    let folder = Folder::new();
    let mut stl = binary_stl(&triangles(), "");
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(
        folder.fault("a.stl", &stl),
        (FilePlace::Byte(80), Trouble::Announced { announced: 4294967295, .. })
    ));
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for (vertices, faces) in [(u64::MAX, 6), (0, u64::MAX), (1 << 40, 1)] {
            let (place, trouble) = folder.fault("a.ply", ply_header(format, vertices, faces) + "1 2 3 4");
            assert!(matches!(trouble, Trouble::Announced { .. }), "{format} {place} {trouble}");
        }
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_with_their_place() {
    let folder = Folder::new();
    for bad in ["nan", "inf", "-inf", "1e999"] {
        let (place, trouble) = folder.fault("a.obj", obj(&quads()).replacen("v 1 ", &format!("v {bad} "), 1));
        assert!(matches!((place, &trouble), (FilePlace::Line(4), Trouble::NotFinite { .. })), "{place} {trouble}");
        let (place, _) =
            folder.fault("a.stl", text_stl(&triangles()).replacen("vertex 0 ", &format!("vertex {bad} "), 1));
        assert_eq!(place, FilePlace::Line(4));
        let (place, _) = folder.fault("a.ply", text_ply().replacen("\n0 0 255 0", &format!("\n0 {bad} 255 0"), 1));
        assert_eq!(place, FilePlace::Line(15));
    }
    let mut stl = binary_stl(&triangles(), "");
    stl[84 + 50 + 24..84 + 50 + 28].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(folder.fault("a.stl", &stl), (FilePlace::Byte(158), Trouble::NotFinite { .. })));
}

#[test]
fn words_that_are_no_numbers_are_quoted() {
    let folder = Folder::new();
    let error = folder.read("a.obj", "v 0 0 zero\n").unwrap_err().to_string();
    assert!(error.contains("line 1") && error.contains("`zero`"), "{error}");
    let error = folder.read("a.stl", "solid\nfacet\nouter loop\nvertex 0 0\n").unwrap_err().to_string();
    assert!(error.contains("line 4") && error.contains("coordinate"), "{error}");
    let error = folder.read("a.ply", "ply\nformat ascii 1.0\nelement vertex many\n").unwrap_err().to_string();
    assert!(error.contains("line 3") && error.contains("`many`"), "{error}");
}

#[test]
fn indices_beyond_the_vertices_are_refused() {
    let folder = Folder::new();
    for (face, index) in
        [("f 1 2 9", 9.0), ("f 0 1 2", 0.0), ("f -9 1 2", -9.0), ("f -9223372036854775808 1 2", i64::MIN as f64)]
    {
        let (place, trouble) = folder.fault("a.obj", obj(&[]) + face);
        assert_eq!((place, trouble), (FilePlace::Line(11), Trouble::NoSuchVertex { index, count: 8 }));
    }
    let (place, trouble) = folder.fault("a.ply", text_ply().replacen("\n4 0 2 3 1", "\n4 0 2 3 8", 1));
    assert_eq!((place, trouble), (FilePlace::Line(23), Trouble::NoSuchVertex { index: 8.0, count: 8 }));
    assert!(matches!(folder.fault("a.obj", obj(&[]) + "f 1 2").1, Trouble::FewCorners { corners: 2 }));
}

#[test]
fn hole_is_named_by_its_edges() {
    let folder = Folder::new();
    let open: Vec<_> = triangles().into_iter().skip(1).collect();
    for (name, content) in [("a.stl", text_stl(&open).into_bytes()), ("b.stl", binary_stl(&open, ""))] {
        let PolyhedronError::Open { count, first } = folder.not_a_body(name, content) else { panic!("{name}") };
        assert_eq!((count, first.len()), (3, 3));
        // The missing triangle (0,0,0), (0,1,0), (1,1,0).
        for edge in first {
            for end in [edge.from, edge.to] {
                assert!(end.z == 0.0 && end.x <= end.y, "{end}");
            }
        }
    }
    let message = folder.read("a.obj", obj(&quads()[1..])).unwrap_err().to_string();
    assert!(message.contains("4 edges with one triangle") && message.contains("fill the holes"), "{message}");
}

#[test]
fn triangle_turned_over_is_found() {
    let mut turned = triangles();
    turned[5].swap(0, 1);
    let fault = Folder::new().not_a_body("a.stl", text_stl(&turned));
    assert!(matches!(fault, PolyhedronError::Misoriented { count: 3, .. }), "{fault}");
}

#[test]
fn inward_surface_is_told_to_flip() {
    let inward: Vec<_> = triangles().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    let fault = Folder::new().not_a_body("a.stl", text_stl(&inward));
    assert!(matches!(fault, PolyhedronError::InsideOut { volume } if volume < 0.0), "{fault}");
    assert!(fault.to_string().contains("flip"), "{fault}");
}

#[test]
fn wall_inside_is_found() {
    let mut walled = quads();
    // A wall along the diagonal, from both sides.
    walled.extend([vec![0, 3, 7, 4], vec![0, 4, 7, 3]]);
    let fault = Folder::new().not_a_body("a.obj", obj(&walled));
    assert!(matches!(fault, PolyhedronError::NonManifold { .. }), "{fault}");
}

#[test]
fn surface_without_volume_is_refused() {
    let folder = Folder::new();
    // Both sides of a square; and triangles whose corners coincide.
    let flat = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n";
    assert!(matches!(folder.not_a_body("a.obj", flat), PolyhedronError::NoVolume { .. }));
    assert!(matches!(
        folder.read("a.stl", text_stl(&[[0, 0, 1], [1, 1, 0]])),
        Err(MeshError::NotABody { .. } | MeshError::Empty { .. })
    ));
    let point = text_stl(&[[0, 0, 0], [0, 0, 0]]);
    let result = folder.read("b.stl", point);
    assert!(result.is_err(), "{result:?}");
}

#[test]
fn triangles_without_area_do_not_open_a_mesh() {
    let mut padded = triangles();
    padded.push([0, 0, 1]);
    assert_is_unit_cube("a.stl", &Folder::new().read("a.stl", text_stl(&padded)).unwrap());
}

#[test]
fn garbage_is_refused_without_a_panic() {
    let folder = Folder::new();
    let mut state = 1_u64;
    let mut byte = || {
        // A linear congruential generator (Knuth's MMIX), so that a failure repeats.
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 56) as u8
    };
    let seeds: [(&str, Vec<u8>); 4] = [
        ("a.stl", text_stl(&triangles()).into()),
        ("a.obj", obj(&quads()).into()),
        ("a.ply", text_ply().into()),
        ("b.ply", binary_ply(false)),
    ];
    for (name, seed) in seeds {
        for _ in 0..300 {
            let mut content = seed.clone();
            for _ in 0..4 {
                let place = (usize::from(byte()) << 8 | usize::from(byte())) % content.len();
                content[place] = byte();
            }
            if let Ok(mesh) = folder.read(name, &content) {
                mesh.validate().unwrap();
            }
        }
    }
}

/// Took hours: a fan was tried from each of the corners.
#[test]
fn polygons_of_very_many_corners_end_soon() {
    let count = 50_000;
    let corner = |k: usize| (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
    let vertices: String = (0..count).map(corner).map(|(y, x)| format!("v {x} {y} 0\n")).collect();
    let face: String = (1..=count).map(|k| format!(" {k}")).collect();
    let read = |text: String| parse_mesh(Path::new("disk.obj"), text.as_bytes(), 1.0);
    let cone: String = (1..=count).map(|k| format!("f {} {k} {}\n", k % count + 1, count + 1)).collect();
    let Err(MeshError::NotABody { fault, .. }) = read(format!("{vertices}f{face}\n")) else {
        panic!("a disk is taken")
    };
    assert!(fault.to_string().contains("not closed"), "{fault}");
    let mesh = read(format!("{vertices}v 0 0 -1\nf{face}\n{cone}")).unwrap_or_else(|error| panic!("{error}"));
    // A third of the area of the base, which is that of the circle to 1e-8.
    assert!((mesh.mass_properties(1.0).volume / (std::f64::consts::PI / 3.0) - 1.0).abs() < 1e-8);
}
