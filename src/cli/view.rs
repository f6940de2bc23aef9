//! `aplomb view`: be with the character in a browser.
//!
//! arguments → session → server, until Ctrl-C.

use std::io::Write;
use std::net::IpAddr;

use anyhow::Result;
use aplomb::live::server::{Reload, Server};
use aplomb::live::{LiveScene, Session};
use clap::Args;

use super::Ending;
use super::output::message;
use super::scene::SceneArgs;
use super::work::stop_on_interrupt;

/// s that a scene lasts in a file if no scenario says.
const OTHERWISE: f64 = 10.0;

/// Be with the character in a browser
///
/// Serves a page on this computer: watch the character, drag and push it, throw things, give
/// commands, see every bid and every clause, go back in time and start from there. Files of the
/// scene, character and repertoire take effect when they are saved. Ctrl-C ends it.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  aplomb view                                          # the humanoid, standing
  aplomb view story
  aplomb view --repertoire examples/mine/mine.ron      # edit the files while it runs")]
pub(super) struct ViewArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// The port; 0 takes a free one
    #[arg(long, value_name = "N", default_value_t = 7227)]
    port: u16,
    /// The address to listen on. Whoever can reach it can use the page: other than loopback only in
    /// a network that you trust
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    host: IpAddr,
    /// Does not open a browser
    #[arg(long)]
    no_open: bool,
}

impl ViewArgs {
    pub(super) fn run(self, out: &mut dyn Write) -> Result<Ending> {
        let registry = aplomb::controllers::registry();
        let scene = LiveScene::new(self.scene.load(OTHERWISE, &registry)?, &registry)?;
        let used = self.scene.names(&scene.scenario);
        let (arguments, kinds) = (self.scene, registry.clone());
        let build = move || {
            let scenario = arguments
                .load(OTHERWISE, &kinds)
                .map_err(|e| format!("{e:#}"))?;
            LiveScene::new(scenario, &kinds).map_err(|e| e.to_string())
        };
        let reload = Reload::new(Box::new(build), &used, &scene, &registry);
        let session = Session::with(scene, registry)?;
        let server = Server::bind(self.host, self.port)?;
        let url = format!("http://{}/", server.address());
        writeln!(out, "{url}")?;
        out.flush()?;
        message(format_args!("Open {url} in a browser. Ctrl-C ends it."));
        let stop = stop_on_interrupt()?;
        if !self.no_open
            && let Err(e) = open::that_detached(&url)
        {
            message(format_args!("cannot open a browser: {e}"));
        }
        server.serve(session, reload, &stop);
        Ok(Ending::Done)
    }
}
