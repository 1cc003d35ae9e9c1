//! Serves the page on this computer: an address that only who was given it knows.

use std::hash::{BuildHasher, RandomState};
use std::io::{self, Read};
use std::net::{Ipv4Addr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use super::http::{self, Answer};
use super::routes::{Door, answer};
use super::state::State;

/// Connections at a time: a page has a few.
const MOST: usize = 32;
/// What is read of a request that is refused \[bytes\].
const REST: u64 = 1 << 20;
/// How long a connection may say nothing.
const SILENCE: Duration = Duration::from_secs(10);

/// A server, until it is dropped.
#[derive(Debug)]
pub struct Server {
    at: SocketAddr,
    address: String,
    ends: Arc<AtomicBool>,
}

impl Server {
    /// Listens on a free port of the loopback.
    ///
    /// # Errors
    /// Those of the system.
    pub fn start(state: Arc<State>) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        let at = listener.local_addr()?;
        let host = at.to_string();
        let token = token();
        let address = format!("http://{host}/{token}/");
        let ends = Arc::new(AtomicBool::new(false));
        let door = Arc::new(Door { host, token, state });
        let over = Arc::clone(&ends);
        thread::Builder::new()
            .name("live page".into())
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
    match http::read(&mut stream) {
        Ok(request) => answer(door, &request).send(&mut stream),
        Err(Some(status)) => {
            Answer::bare(status).send(&mut stream)?;
            stream.shutdown(Shutdown::Write)?;
            // What is not read would take the answer back.
            io::copy(&mut stream.take(REST), &mut io::sink()).map(drop)
        }
        Err(None) => Ok(()),
    }
}
