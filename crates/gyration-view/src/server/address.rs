//! The address of the page: a port of this machine, and a token that only who was given the address can know.
//!
//! Other users of the machine, and pages from elsewhere in the same browser, may find the port. They cannot guess 128
//! random bits.

use crate::error::ViewError;
use axum::http::{HeaderMap, HeaderName, header};

/// Random bytes in a token.
const TOKEN_BYTES: usize = 16;

/// Where the page is.
#[derive(Clone)]
pub(super) struct Address {
    port: u16,
    token: String,
}

impl Address {
    /// An address at a port, with a token that has never been before.
    pub(super) fn fresh(port: u16) -> Result<Self, ViewError> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(ViewError::NoRandomNumbers)?;
        Ok(Self { port, token: bytes.iter().map(|byte| format!("{byte:02x}")).collect() })
    }

    /// As a browser is given it.
    pub(super) fn url(&self) -> String {
        format!("http://127.0.0.1:{}{}/", self.port, self.root())
    }

    /// The path under which everything is, without a slash at its end.
    pub(super) fn root(&self) -> String {
        format!("/{}", self.token)
    }

    /// Whether a path begins with the token. How long it takes does not tell where they differ.
    pub(super) fn has(&self, path: &str) -> bool {
        let first = path.strip_prefix('/').and_then(|rest| rest.split('/').next()).unwrap_or_default();
        let differences = first.bytes().zip(self.token.bytes()).fold(0, |all, (a, b)| all | (a ^ b));
        first.len() == self.token.len() && std::hint::black_box(differences) == 0
    }

    /// Whether a request calls this server by its own name, and comes from its own page if from any.
    pub(super) fn is_called(&self, headers: &HeaderMap) -> bool {
        let names = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        let text = |name: &HeaderName| headers.get(name).map(|value| value.to_str().unwrap_or_default());
        let host = text(&header::HOST).is_some_and(|host| names.iter().any(|name| name == host));
        let from_us = |origin: &str| names.iter().any(|name| format!("http://{name}") == origin);
        host && text(&header::ORIGIN).is_none_or(from_us)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    fn asks(pairs: &[(HeaderName, &'static str)]) -> bool {
        let mut headers = HeaderMap::new();
        for (name, value) in pairs {
            headers.insert(name.clone(), HeaderValue::from_static(value));
        }
        Address { port: 8000, token: String::new() }.is_called(&headers)
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

    #[test]
    fn every_server_has_a_token_of_its_own_and_takes_no_other() {
        let (one, other) = (Address::fresh(8000).unwrap(), Address::fresh(8000).unwrap());
        assert_eq!(one.token.len(), 2 * TOKEN_BYTES);
        assert!(one.has(&one.root()) && one.has(&format!("{}/api/header", one.root())));
        assert!(!one.has(&other.root()) && !one.has("/") && !one.has("") && !one.has("/api/header"));
        let (all, part) = (one.root(), one.token.len());
        assert!(!one.has(&all[..part]) && !one.has(&format!("{all}0")) && !one.has(&format!("//{}", one.token)));
    }
}
