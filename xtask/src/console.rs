//! Where the steps print: those of the main lane as they go, those beside it as one block when they end.
//!
//! Steps that run side by side must not mix their lines. A block of the lane beside waits until the main lane is
//! between two steps.

use std::io::Write;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What the lanes share.
#[derive(Debug, Default)]
struct ConsoleState {
    /// Whether the main lane is within a step.
    busy: bool,
    /// Blocks of the lane beside that wait.
    waiting: String,
}

/// The console of one lane.
#[derive(Debug, Default)]
pub struct Console {
    shared: Arc<Mutex<ConsoleState>>,
    /// The lines of this step, in a lane beside the main one.
    block: Option<String>,
}

impl Console {
    /// The console of a lane beside this one.
    pub fn beside(&self) -> Self {
        Self { shared: Arc::clone(&self.shared), block: Some(String::new()) }
    }

    /// A step begins.
    pub fn begin(&mut self) {
        if self.block.is_none() {
            self.shared().busy = true;
        }
    }

    /// One line of it.
    pub fn line(&mut self, line: &str) {
        match &mut self.block {
            Some(block) => {
                block.push_str(line);
                block.push('\n');
            }
            None => println!("{line}"),
        }
    }

    /// The step has ended.
    pub fn end(&mut self) {
        let block = self.block.as_mut().map(std::mem::take);
        let mut shared = self.shared();
        match block {
            None => shared.busy = false,
            Some(block) => shared.waiting.push_str(&block),
        }
        if !shared.busy {
            print!("{}", std::mem::take(&mut shared.waiting));
        }
        let _ = std::io::stdout().flush();
    }

    fn shared(&self) -> MutexGuard<'_, ConsoleState> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_waits_for_the_step_of_the_main_lane() {
        let mut main = Console::default();
        let mut beside = main.beside();
        main.begin();
        beside.begin();
        beside.line("of the lane beside");
        beside.end();
        assert_eq!(main.shared().waiting, "of the lane beside\n");
        main.end();
        assert_eq!(main.shared().waiting, "");
    }
}
