//! Serves a page on this computer: at an address that only who was given it knows.

use std::hash::{BuildHasher, RandomState};
use std::io::{self, Read};
use std::net::{Ipv4Addr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use super::http::{self, Answer, Request};

/// Connections at a time: a page has a few.
const MOST: usize = 32;
/// What is read of a request that is refused \[bytes\].
const REST: u64 = 1 << 20;
/// How long a connection may say nothing.
const SILENCE: Duration = Duration::from_secs(10);

/// What is served, and what one has to know to be let in.
struct Door {
    /// Address and port, as a browser names them.
    host: String,
    token: String,
    /// Longest body of a request \[bytes\].
    most: usize,
    answers: Box<Answers>,
}

/// The answer to a request, and to its path below the token.
pub type Answers = dyn Fn(&Request, &str) -> Answer + Send + Sync;

impl Door {
    /// The answer for who asks this server and not another name of it, has the token, and is no page from elsewhere.
    fn answer(&self, request: &Request) -> Answer {
        let own = format!("http://{}", self.host);
        let is_own = request.origin.as_ref().is_none_or(|origin| *origin == own);
        let path = request.path.strip_prefix('/');
        let path = path.and_then(|path| path.strip_prefix(self.token.as_str())?.strip_prefix('/'));
        match path {
            Some(path) if request.host == self.host && is_own => (self.answers)(request, path),
            Some(_) | None => Answer::bare(403),
        }
    }
}

/// A server, until it is dropped.
#[derive(Debug)]
pub struct Server {
    at: SocketAddr,
    address: String,
    ends: Arc<AtomicBool>,
}

impl Server {
    /// Listens on a free port of the loopback, for requests with bodies of so many bytes at most.
    ///
    /// # Errors
    /// Those of the system.
    pub fn start(most: usize, answers: Box<Answers>) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        let at = listener.local_addr()?;
        let host = at.to_string();
        let token = token();
        let address = format!("http://{host}/{token}/");
        let ends = Arc::new(AtomicBool::new(false));
        let door = Arc::new(Door {
            host,
            token,
            most,
            answers,
        });
        let over = Arc::clone(&ends);
        thread::Builder::new()
            .name("page".into())
            .spawn(move || serve(&listener, &door, &over))?;
        Ok(Server { at, address, ends })
    }

    /// Where the page is.
    pub fn address(&self) -> &str {
        &self.address
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::SeqCst);
        // Wakes who listens; one that can't be woken ends with the process.
        let _ = TcpStream::connect_timeout(&self.at, Duration::from_millis(100));
    }
}

/// 128 bits that nobody guesses: a keyed hash whose keys the system draws.
fn token() -> String {
    let keyed = RandomState::new();
    let bits: [u64; 2] = [0_u8, 1].map(|part| keyed.hash_one(part));
    format!("{:016x}{:016x}", bits[0], bits[1])
}

fn serve(listener: &TcpListener, door: &Arc<Door>, ends: &AtomicBool) {
    let open = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        if ends.load(Ordering::SeqCst) {
            return;
        }
        let Ok(stream) = stream else { continue };
        if open.fetch_add(1, Ordering::SeqCst) >= MOST {
            open.fetch_sub(1, Ordering::SeqCst);
            continue;
        }
        let (door, count) = (Arc::clone(door), Arc::clone(&open));
        let talk = move || {
            // A browser that has gone away needs no answer.
            let _ = talk(stream, &door);
            count.fetch_sub(1, Ordering::SeqCst);
        };
        if thread::Builder::new().spawn(talk).is_err() {
            open.fetch_sub(1, Ordering::SeqCst);
        }
    }
}

fn talk(mut stream: TcpStream, door: &Door) -> io::Result<()> {
    stream.set_read_timeout(Some(SILENCE))?;
    stream.set_write_timeout(Some(SILENCE))?;
    stream.set_nodelay(true)?;
    match http::read(&mut stream, door.most) {
        Ok(request) => door.answer(&request).send(&mut stream),
        Err(Some(status)) => {
            Answer::bare(status).send(&mut stream)?;
            stream.shutdown(Shutdown::Write)?;
            // What is not read would take the answer back.
            io::copy(&mut stream.take(REST), &mut io::sink()).map(drop)
        }
        Err(None) => Ok(()),
    }
}
