//! The socket, and the end of the server.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::time::Duration;

use thiserror::Error;
use tokio::runtime::Builder;
use tokio::sync::oneshot;

use crate::app::{App, Limits, Start};
use crate::router::router;

/// How long the requests under way are waited for when the server stops.
const FAREWELL: Duration = Duration::from_secs(2);

/// Why there is no server.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ServeError {
    /// Somebody else listens on the port.
    #[error("port {port} of 127.0.0.1 is taken by another program; say another --port, or --port 0 for a free one")]
    Taken {
        /// The port.
        port: u16,
    },
    /// The port cannot be listened on.
    #[error("cannot listen on port {port} of 127.0.0.1: {cause}")]
    Listen {
        /// The port.
        port: u16,
        /// What the system said.
        cause: io::Error,
    },
    /// The server cannot begin or go on.
    #[error("the server cannot run: {0}")]
    Run(io::Error),
}

/// A server that listens, on 127.0.0.1 alone, and does not answer yet.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    app: Arc<App>,
    limits: Limits,
}

impl Server {
    /// Listens on a port; 0 is a free one. The page opens with `start`.
    ///
    /// # Errors
    /// When the port cannot be had.
    pub fn bind(port: u16, start: Start, limits: Limits) -> Result<Self, ServeError> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|cause| match cause.kind() {
            io::ErrorKind::AddrInUse => ServeError::Taken { port },
            _ => ServeError::Listen { port, cause },
        })?;
        listener.set_nonblocking(true).map_err(ServeError::Run)?;
        let address = listener.local_addr().map_err(ServeError::Run)?;
        let app = Arc::new(App::new(start, limits).map_err(ServeError::Run)?);
        Ok(Self { listener, address, app, limits })
    }

    /// The address of the page.
    #[must_use]
    pub fn address(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// Answers until `stop` returns, which waits on a thread of its own; then the requests under way are waited for,
    /// for a moment, and the files of the server go.
    ///
    /// # Errors
    /// When the server cannot run.
    pub fn run<T: Send + 'static>(self, stop: impl FnOnce() -> T + Send + 'static) -> Result<T, ServeError> {
        let Self { listener, address, app, limits } = self;
        let (stopped, stopping) = oneshot::channel();
        let waiting = std::thread::Builder::new().name("stop".to_owned()).spawn(move || {
            let why = stop();
            // Where the server has ended by itself nobody listens.
            let _ = stopped.send(());
            why
        });
        let waiting = waiting.map_err(ServeError::Run)?;
        let workers = limits.workers.max(1);
        let runtime = Builder::new_current_thread().enable_all().max_blocking_threads(workers).build();
        let runtime = runtime.map_err(ServeError::Run)?;
        let routes = router(Arc::clone(&app), address.port());
        let served = runtime.block_on(serve(listener, routes, stopping));
        // Work that is still under way is left alone.
        runtime.shutdown_background();
        drop(app);
        served.map_err(ServeError::Run)?;
        waiting.join().map_err(|_| ServeError::Run(io::Error::other("the thread that waits for the end has failed")))
    }
}

async fn serve(listener: TcpListener, routes: axum::Router, stopping: oneshot::Receiver<()>) -> io::Result<()> {
    let listener = tokio::net::TcpListener::from_std(listener)?;
    let (last, farewell) = oneshot::channel();
    let graceful = axum::serve(listener, routes).with_graceful_shutdown(async {
        let _ = stopping.await;
        let _ = last.send(());
    });
    let deadline = async {
        let _ = farewell.await;
        tokio::time::sleep(FAREWELL).await;
    };
    tokio::select! {
        served = graceful => served,
        () = deadline => Ok(()),
    }
}
