"""Makes of the Python package what the reference is read from: `python reference.py PACKAGE SOURCES OUT VERSION`.

The types stand in the stub, `_gyration.pyi`, the words in the doc comments of Rust. Both together are a module of
Python whose functions do nothing, which autodoc imports: neither a compiler nor NumPy is needed. A name that the
package hands out and nothing describes is an error.
"""

import ast
import re
import shutil
import sys
from pathlib import Path

ITEM = re.compile(r"(?:pub(?:\(\w+\))? )?(?:struct|impl|fn) (\w+)")


def comments(text):
    """The doc comments of a file of Rust, by (class, name) as Python calls them; class is None for functions."""
    found, owner, words, attributes = {}, None, [], ""
    open_brackets = 0
    for line in text.splitlines():
        bare = line.strip()
        if open_brackets > 0 or bare.startswith("#["):
            attributes += bare
            open_brackets = attributes.count("[") - attributes.count("]")
        elif bare.startswith("///"):
            words.append(bare[3:].removeprefix(" "))
        else:
            item = ITEM.match(bare)
            if line == "}":
                owner = None
            elif item:
                renamed = re.search(r'\bname = "(\w+)"|getter\((\w+)\)', attributes)
                name = (renamed.group(1) or renamed.group(2)) if renamed else item.group(1)
                if "#[pymethods]" in attributes:
                    owner = name
                elif "#[pyclass" in attributes or "#[pyfunction]" in attributes:
                    found[None, name] = "\n".join(words)
                elif owner:
                    found[owner, name] = "\n".join(words)
            words, attributes = [], ""
    return found


class Described(ast.NodeTransformer):
    """A stub with aliases written out, words put in, and without what is not for users."""

    def __init__(self, aliases, words):
        self.aliases, self.words, self.owner, self.missing = aliases, words, None, []

    def visit_Name(self, node):
        alias = self.aliases.get(node.id)
        return node if alias is None else self.visit(ast.parse(alias, mode="eval").body)

    def visit_ClassDef(self, node):
        self.owner = node.name
        self.describe(node, (None, node.name))
        node.body = [member for member in map(self.visit, node.body) if member is not None]
        self.owner = None
        return node

    def visit_FunctionDef(self, node):
        if node.name.startswith("__") and node.name != "__new__" and not self.words.get((self.owner, node.name)):
            return None
        self.generic_visit(node)
        self.describe(node, (self.owner, node.name))
        return node

    def describe(self, node, key):
        words = self.words.get(key, "")
        if words:
            node.body.insert(0, ast.Expr(ast.Constant(words)))
        elif not any(part.startswith("_") for part in key if part):
            self.missing.append(".".join(part for part in key if part))


def module(stub, words, version):
    """The source of the module, and what nothing describes."""
    tree = ast.parse(stub)
    aliases, kept = {}, []
    for node in tree.body:
        if isinstance(node, ast.Assign) and node.targets[0].id != "__all__":
            aliases[node.targets[0].id] = ast.unparse(node.value)
        elif not (isinstance(node, (ast.Import, ast.ImportFrom)) and "numpy" in ast.unparse(node)):
            kept.append(node)
    # An array is an array: its kind of numbers is told by the words.
    aliases |= {"_Array": "ndarray", "_Vector": "ArrayLike", "_Matrix": "ArrayLike"}
    described = Described(aliases, words)
    lines = ["from __future__ import annotations"]
    for node in kept:
        if isinstance(node, ast.AnnAssign):
            node.value = ast.Constant(version)
        lines.append(ast.unparse(ast.fix_missing_locations(described.visit(node))))
    return "\n".join(lines) + "\n", described.missing


def page(package):
    """The page of the reference: the classes, functions and exceptions that the package hands out."""
    names = ast.parse((package / "__init__.py").read_text()).body
    names = next(node for node in names if isinstance(node, ast.Assign))
    public = [name for name in ast.literal_eval(names.value) if not name.startswith("_")]
    faults = [name for name in public if name.endswith("Error") or name == "Diagnostic"]
    classes = [name for name in public if name[0].isupper() and name not in faults]
    functions = [name for name in public if name[0].islower()]
    text = "Python reference\n================\n\n"
    text += "Every class, function and exception of the package ``gyration``. :doc:`python` tells how to use them.\n\n"
    text += "Lengths are in m, masses in kg, times in s, forces in N, angles in rad. Vectors have 3 entries, matrices\n"
    text += "3 × 3, row by row. A scene may be given as a :class:`Scene`, a dictionary of its keys or the path of a file.\n\n"
    text += ".. currentmodule:: gyration\n\n"
    first = ["Scene", "Recording", "Simulation"]
    for name in first + [name for name in classes if name not in first]:
        text += f"{name}\n{'-' * len(name)}\n\n.. autoclass:: {name}\n   :members:\n   :special-members: __getitem__\n\n"
    text += "Functions\n---------\n\n" + "".join(f".. autofunction:: {name}\n\n" for name in functions)
    text += "Exceptions\n----------\n\n"
    for name in sorted(faults, key=lambda name: name != "Error"):
        text += f".. autoclass:: {name}\n   :members:\n   :show-inheritance:\n\n"
    return text


def main(package, sources, out, version):
    words = {}
    for file in sorted(sources.glob("*.rs")):
        words |= comments(file.read_text())
    source, missing = module((package / "_gyration.pyi").read_text(), words, version)
    if missing:
        sys.exit(f"nothing describes {', '.join(missing)}: a doc comment is missing in {sources}")
    shutil.rmtree(out, ignore_errors=True)
    (out / "gyration").mkdir(parents=True)
    for file in package.glob("*.py"):
        shutil.copy(file, out / "gyration")
    (out / "gyration" / "_gyration.py").write_text(source)
    (out / "python-reference.rst").write_text(page(package))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:4]), sys.argv[4])
