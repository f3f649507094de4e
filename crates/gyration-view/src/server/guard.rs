//! Who may ask: the page that this server gave out, under the name that it gave out.
//!
//! `Host` must be ours, against names elsewhere that are made to lead here; `Origin`, where a browser sends one, must
//! be our page. Answers forbid the page to load or call anything but this server.

use crate::page;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// Refuses requests from elsewhere, and tells browsers what the page may do.
pub(super) async fn guard(State(port): State<u16>, request: Request, next: Next) -> Response {
    if !is_ours(request.headers(), port) {
        let words = "this server answers to its own page only, at the address that `gyration view` printed\n";
        return (StatusCode::FORBIDDEN, words).into_response();
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

/// Whether a request calls this server by its own name, and comes from its own page if from any.
fn is_ours(headers: &HeaderMap, port: u16) -> bool {
    let names = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}"));
    let text = |name: &HeaderName| headers.get(name).map(|value| value.to_str().unwrap_or_default());
    let host = text(&header::HOST).is_some_and(|host| names.iter().any(|name| name == host));
    let origin = text(&header::ORIGIN).is_none_or(|origin| names.iter().any(|name| format!("http://{name}") == origin));
    host && origin
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asks(pairs: &[(HeaderName, &'static str)]) -> bool {
        let mut headers = HeaderMap::new();
        for (name, value) in pairs {
            set(&mut headers, name.clone(), value);
        }
        is_ours(&headers, 8000)
    }

    #[test]
    fn the_policy_is_a_header_and_allows_no_script_but_that_of_the_page() {
        assert!(HeaderValue::from_str(&policy()).is_ok());
        let scripts = policy().split("script-src ").nth(1).and_then(|rest| Some(rest.split_once(';')?.0.to_owned()));
        assert_eq!(scripts.as_deref(), Some(page::scripts()));
    }

    #[test]
    fn only_the_own_page_under_the_own_name_may_ask() {
        let (host, origin) = (header::HOST, header::ORIGIN);
        assert!(asks(&[(host.clone(), "127.0.0.1:8000")]));
        assert!(asks(&[(host.clone(), "localhost:8000"), (origin.clone(), "http://localhost:8000")]));
        assert!(!asks(&[]));
        assert!(!asks(&[(host.clone(), "127.0.0.1:8001")]));
        assert!(!asks(&[(host.clone(), "rebound.example:8000")]));
        assert!(!asks(&[(host.clone(), "127.0.0.1:8000"), (origin.clone(), "http://elsewhere.example")]));
        assert!(!asks(&[(host.clone(), "127.0.0.1:8000"), (origin.clone(), "null")]));
        assert!(!asks(&[(host, "127.0.0.1:8000"), (origin, "http://127.0.0.1:8000.elsewhere.example")]));
    }
}
