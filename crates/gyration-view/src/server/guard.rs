//! Who may ask: the page that this server gave out, under the name that it gave out, with the token that it gave out.
//!
//! `Host` must be ours, against names elsewhere that are made to lead here; `Origin`, where a browser sends one, must
//! be our page; the path must begin with the token. Answers forbid the page to load or call anything but this server.

use super::address::Address;
use super::connections::Visitor;
use crate::page;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::sync::Arc;

/// What a request is told that comes from elsewhere, or without the token.
const REFUSED: &str =
    "open the address that `gyration view` printed, whole: it has a token that every request must have\n";

/// Refuses requests from elsewhere, and tells browsers what the page may do.
pub(super) async fn guard(State(address): State<Address>, request: Request, next: Next) -> Response {
    if !address.is_called(request.headers()) || !address.has(request.uri().path()) {
        // Who may not ask does not keep a connection either.
        return (StatusCode::FORBIDDEN, [(header::CONNECTION, "close")], REFUSED).into_response();
    }
    if let Some(visitor) = request.extensions().get::<Arc<Visitor>>().cloned() {
        visitor.show_token().await;
    }
    let mut response = next.run(request).await;
    if let Ok(policy) = HeaderValue::from_str(&policy()) {
        response.headers_mut().insert(header::CONTENT_SECURITY_POLICY, policy);
    }
    for (name, value) in [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
    ] {
        set(response.headers_mut(), name, value);
    }
    response
}

/// What a page from here may do: run its own script, by its hash, and ask this server.
fn policy() -> String {
    format!(
        "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; \
         base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        page::scripts()
    )
}

fn set(headers: &mut HeaderMap, name: HeaderName, value: &'static str) {
    headers.insert(name, HeaderValue::from_static(value));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_policy_is_a_header_and_allows_no_script_but_that_of_the_page() {
        assert!(HeaderValue::from_str(&policy()).is_ok());
        let scripts = policy().split("script-src ").nth(1).and_then(|rest| Some(rest.split_once(';')?.0.to_owned()));
        assert_eq!(scripts.as_deref(), Some(page::scripts()));
    }
}
