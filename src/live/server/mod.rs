//! The live view's server: one session, any number of browsers.
//!
//! [`Session`], a listening socket → page, WebSocket, saves. The session runs in the caller's thread
//! at its own pace; every connection has a thread and a bounded box of what is still to be sent, so
//! that nobody who is slow, silent or gone disturbs the run or the others.

mod connection;
mod http;
mod outbox;
mod page;
mod reload;
mod saves;
mod unheard;

use std::collections::BTreeMap;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::time::{Duration, Instant};

use aplomb_framework::input::{Error, Result};

use crate::live::save::Replay;
use crate::live::session::Session;
use crate::live::watcher::Watcher;

use outbox::{Outbox, Slot};
pub use reload::Reload;
use unheard::Unheard;

/// At most so many connections at a time; others are turned away.
const MOST_CONNECTIONS: usize = 64;
/// Messages that wait to be heard.
const MOST_WAITING: usize = 1024;
/// How long messages are heard before a frame is made, however many there are.
const HEARING: Duration = Duration::from_millis(10);
/// Frames a second.
const FRAMES: f64 = 60.0;
/// How long the doorkeeper sleeps while nobody knocks.
const DOORKEEPER: Duration = Duration::from_millis(5);

/// What connections say to the session.
enum Said {
    Joined(u64, Arc<Outbox>),
    Text(u64, String, Slot),
    Left(u64),
    /// Somebody wants what was done so far.
    Save(SyncSender<Replay>),
}

/// A server that listens.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
}

impl Server {
    /// Listens on an address; port 0 takes a free one.
    ///
    /// # Errors
    /// A port that is taken, an address that is not this computer's.
    pub fn bind(host: IpAddr, port: u16) -> Result<Self> {
        let refused = |e: std::io::Error| {
            let accepted = "an address of this computer and a free port (0 takes any)";
            Error::invalid("view", "address", format!("{host}:{port}: {e}"), accepted)
        };
        let listener = TcpListener::bind((host, port)).map_err(refused)?;
        listener.set_nonblocking(true).map_err(refused)?;
        let address = listener.local_addr().map_err(refused)?;
        Ok(Self { listener, address })
    }

    /// Where it listens.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Serves until `stop` is set. `reload` looks after the files that the scene was read from.
    pub fn serve(self, mut session: Session, mut reload: Option<Reload>, stop: &Arc<AtomicBool>) {
        let (say, heard) = sync_channel(MOST_WAITING);
        let mut unheard = Unheard::new(heard);
        let doorkeeper = {
            let (stop, address) = (Arc::clone(stop), self.address);
            std::thread::spawn(move || keep_door(&self.listener, address, &say, &stop))
        };
        let mut watchers = BTreeMap::new();
        let between = Duration::from_secs_f64(1.0 / FRAMES);
        let mut begun = false;
        let (mut last, mut next) = (Instant::now(), Instant::now() + between);
        while !stop.load(Ordering::Relaxed) {
            let until = Instant::now() + HEARING;
            while let Some(said) = unheard.next() {
                hear(said, &mut session, &mut watchers);
                if Instant::now() > until {
                    break;
                }
            }
            if let Some(news) = reload.as_mut().and_then(|r| r.look(&mut session)) {
                watchers.values().for_each(|w| w.outbox.put(news.clone()));
            }
            let now = Instant::now();
            tell(&session, &mut watchers);
            // Nothing is missed: it begins when the first watcher is there, and waits for nobody after.
            begun |= !watchers.is_empty();
            if begun {
                session.advance((now - last).as_secs_f64());
            }
            last = now;
            tell(&session, &mut watchers);
            for Connected { watcher, outbox } in watchers.values_mut() {
                watcher.view.dropped = outbox.dropped();
                outbox.put_frame(session.frame(&watcher.view));
            }
            next = next.max(Instant::now());
            while let Some(said) = unheard.before(next) {
                hear(said, &mut session, &mut watchers);
            }
            next += between;
        }
        watchers.values().for_each(|w| w.outbox.close());
        // It looks at `stop` every few milliseconds.
        drop(doorkeeper.join());
    }
}

struct Connected {
    watcher: Watcher,
    outbox: Arc<Outbox>,
}

fn hear(said: Said, session: &mut Session, watchers: &mut BTreeMap<u64, Connected>) {
    match said {
        Said::Joined(id, outbox) => {
            let watcher = Watcher::default();
            watchers.insert(id, Connected { watcher, outbox });
        }
        Said::Left(id) => drop(watchers.remove(&id)),
        Said::Text(id, text, _slot) => {
            // Who is gone wants nothing any more.
            if let Some(Connected { watcher, outbox }) = watchers.get_mut(&id)
                && !outbox.is_closed()
                && let Some(refusal) = watcher.ask(session, &text)
            {
                outbox.put(refusal);
            }
        }
        // Who asked may be gone.
        Said::Save(answer) => drop(answer.try_send(session.replay())),
    }
}

fn tell(session: &Session, watchers: &mut BTreeMap<u64, Connected>) {
    for Connected { watcher, outbox } in watchers.values_mut() {
        for news in watcher.news(session, true) {
            outbox.put(news);
        }
    }
}

/// Lets in who knocks, up to so many.
fn keep_door(
    listener: &TcpListener,
    address: SocketAddr,
    say: &SyncSender<Said>,
    stop: &Arc<AtomicBool>,
) {
    let inside = Arc::new(AtomicUsize::new(0));
    let saves = Arc::new(AtomicUsize::new(0));
    let mut id = 0;
    while !stop.load(Ordering::Relaxed) {
        let Ok((stream, _)) = listener.accept() else {
            std::thread::sleep(DOORKEEPER);
            continue;
        };
        if inside.fetch_add(1, Ordering::Relaxed) >= MOST_CONNECTIONS {
            inside.fetch_sub(1, Ordering::Relaxed);
            http::turn_away(stream);
            continue;
        }
        id += 1;
        let visitor = connection::Visitor {
            id,
            address,
            say: say.clone(),
            saves: Arc::clone(&saves),
            stop: Arc::clone(stop),
        };
        let inside_now = Arc::clone(&inside);
        let visit = move || {
            visitor.visit(stream);
            inside_now.fetch_sub(1, Ordering::Relaxed);
        };
        let thread = std::thread::Builder::new().name("visitor".into());
        if thread.spawn(visit).is_err() {
            inside.fetch_sub(1, Ordering::Relaxed);
        }
    }
}
