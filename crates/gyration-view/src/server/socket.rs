//! The websocket of a live run: what is new goes out, what the watcher wants comes in.

use super::shown::{BadRequest, Shown};
use crate::live::{Live, LiveState, Wish};
use axum::extract::State;
use axum::extract::ws::{self, WebSocket, WebSocketUpgrade};
use axum::http::StatusCode;
use axum::response::Response;
use gyration_page::store::{Cursor, Message};
use std::sync::Arc;
use std::time::Duration;

/// Between two looks at the store; thirty pictures a second are enough.
const PACE: Duration = Duration::from_millis(33);
/// A watcher's wish is short; a mistaken client must not fill the memory.
const MOST_BYTES: usize = 1 << 20;

/// Opens the websocket.
pub(super) async fn live(State(shown): State<Arc<Shown>>, upgrade: WebSocketUpgrade) -> Result<Response, BadRequest> {
    let Shown::Live(live) = &*shown else {
        return Err(BadRequest(StatusCode::NOT_FOUND, "this is a recording: see /api/header".to_owned()));
    };
    let live: Live = live.clone();
    Ok(upgrade.max_message_size(MOST_BYTES).on_upgrade(|socket| async move {
        // A page that goes away ends this in the middle of a message: there is nobody left to tell.
        let _ = converse(socket, &live.watch()).await;
    }))
}

/// Sends what is new and does what is wanted, until the page goes away.
async fn converse(mut socket: WebSocket, shared: &Arc<LiveState>) -> Result<(), axum::Error> {
    let mut news = shared.news.subscribe();
    let mut cursor = Cursor::default();
    loop {
        let messages = shared.store().take(&mut cursor);
        let idle = messages.is_empty();
        for message in messages {
            socket.send(carried(message)).await?;
        }
        let pause = async {
            if idle {
                // The sender lives as long as `shared`: this cannot fail.
                let _ = news.changed().await;
            }
            tokio::time::sleep(PACE).await;
        };
        tokio::select! {
            wish = socket.recv() => match wish {
                Some(Ok(ws::Message::Text(text))) => grant(shared, &text, &mut socket).await?,
                Some(Ok(ws::Message::Close(_))) | None => return Ok(()),
                Some(Ok(_)) => {}
                Some(Err(error)) => return Err(error),
            },
            () = pause => {}
        }
    }
}

async fn grant(shared: &LiveState, text: &str, socket: &mut WebSocket) -> Result<(), axum::Error> {
    match Wish::parse(text) {
        Ok(Wish::Pause) => shared.pause(true),
        Ok(Wish::Resume) => shared.pause(false),
        Ok(Wish::Restart { set }) => shared.restart(set),
        Err(reason) => {
            let words = serde_json::json!({ "type": "error", "message": reason });
            socket.send(ws::Message::Text(words.to_string().into())).await?;
        }
    }
    Ok(())
}

/// As the websocket carries it.
fn carried(message: Message) -> ws::Message {
    match message {
        Message::Text(text) => ws::Message::Text(text.into()),
        Message::Binary(bytes) => ws::Message::Binary(bytes.into()),
    }
}
