//! Exports by plain names, which the language takes for unsafe. Natively the names stay mangled: `open` is a function
//! of the C library.

#![allow(unsafe_code, reason = "exported names")]

use crate::engine::Engine;
use gyration_page::FileFormat;
use std::cell::RefCell;
use std::sync::{Mutex, Once, PoisonError};

thread_local! {
    static ENGINE: RefCell<Engine> = RefCell::default();
    static INPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static SAVED: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// The words of the last panic.
static WORDS: Mutex<String> = Mutex::new(String::new());

/// Keeps what a panic says: a module that traps has no other voice.
fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        std::panic::set_hook(Box::new(|panic| {
            *WORDS.lock().unwrap_or_else(PoisonError::into_inner) = panic.to_string();
        }));
    });
}

/// Room for so many bytes of input.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn input(len: usize) -> *mut u8 {
    INPUT.with_borrow_mut(|input| {
        input.resize(len, 0);
        input.as_mut_ptr()
    })
}

/// Takes a file that scenes may name: the first bytes of the input are its name, those behind them its content.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn file(name: usize, content: usize) {
    let input = INPUT.take();
    let (name, rest) = input.split_at(name.min(input.len()));
    let content = rest.get(..content).unwrap_or(rest).to_vec();
    ENGINE.with_borrow_mut(|engine| engine.give(&String::from_utf8_lossy(name), content));
}

/// Begins what the first bytes of the input ask for; 1 if that is refused.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn open(len: usize) -> u32 {
    listen();
    let is_open =
        INPUT.with_borrow(|input| ENGINE.with_borrow_mut(|engine| engine.open(input.get(..len).unwrap_or(input))));
    u32::from(!is_open)
}

/// Goes on for about so many evaluations of the rates.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn advance(evaluations: u32) -> u32 {
    ENGINE.with_borrow_mut(|engine| engine.advance(evaluations.into()) as u32)
}

/// The messages since the last call.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn output() -> *const u8 {
    OUTPUT.with_borrow_mut(|output| {
        *output = ENGINE.with_borrow_mut(|engine| engine.frames());
        output.as_ptr()
    })
}

/// The length of these.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn output_len() -> usize {
    OUTPUT.with_borrow(Vec::len)
}

/// Makes a part of the run so far as a file, of format 0 (CSV) or 1 (GLB); 0 behind the last one, 1 if it is there, 2
/// if the words of a failure are.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn save(format: u32, part: usize) -> u32 {
    let format = if format == 0 { FileFormat::Csv } else { FileFormat::Glb };
    let made = ENGINE.with_borrow(|engine| engine.save(format, part));
    let (answer, bytes) = match made {
        Ok(None) => (0, Vec::new()),
        Ok(Some(bytes)) => (1, bytes),
        Err(words) => (2, words.into_bytes()),
    };
    SAVED.replace(bytes);
    answer
}

/// That part, or these words.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn saved() -> *const u8 {
    SAVED.with_borrow(|saved| saved.as_ptr())
}

/// Their length.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn saved_len() -> usize {
    SAVED.with_borrow(Vec::len)
}

/// The words of the last panic.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn message() -> *const u8 {
    WORDS.lock().unwrap_or_else(PoisonError::into_inner).as_ptr()
}

/// Their length.
#[cfg_attr(target_family = "wasm", unsafe(no_mangle))]
pub extern "C" fn message_len() -> usize {
    WORDS.lock().unwrap_or_else(PoisonError::into_inner).len()
}
