//! A specification compiled by RTLola's compiler, with events in memory:
//! compiled TRACE_FOLDER SAMPLES ROUNDS
//!
//! `benchmarks/peers_run.py` puts two parts beside this file: `main.rs` is the output of the
//! compiler, and `count` counts the active rules.

use std::path::Path;
use std::time::Duration;

use peers::{cpu_seconds, report, Trace};

include!("main.rs");
include!("count.rs");

const PERIOD_NS: u64 = 10_000_000;

fn event(trace: &Trace, row: usize) -> Event {
    Event {
        speed: Some(trace.speed[row]),
        pitch: Some(trace.pitch[row]),
        distance: Some(trace.distance[row]),
        force_z: Some(trace.force_z[row]),
        contact: Some(trace.contact[row] != 0),
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |index: usize| arguments[index].parse::<usize>().expect("a number");
    let (samples, rounds) = (number(2), number(3));
    let trace = Trace::load(Path::new(&arguments[1]), samples);
    let mut seconds = Vec::new();
    let mut counts = [0; 3];
    for _ in 0..rounds {
        let mut monitor = Monitor::new(Duration::ZERO);
        counts = [0; 3];
        let start = cpu_seconds();
        for row in 0..samples {
            let at = Duration::from_nanos(row as u64 * PERIOD_NS);
            for verdict in monitor.accept_event(event(&trace, row), at).expect("accepted") {
                count(&verdict, &mut counts);
            }
        }
        seconds.push(cpu_seconds() - start);
    }
    report(seconds, samples, counts);
}
