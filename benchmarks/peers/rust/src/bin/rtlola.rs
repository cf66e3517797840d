//! RTLola's interpreter with events in memory: rtlola TRACE_FOLDER SPEC.lola SAMPLES ROUNDS

use std::convert::Infallible;
use std::path::Path;
use std::time::Duration;

use peers::{cpu_seconds, report, Trace};
use rtlola_interpreter::monitor::{Change, Incremental, Monitor};
use rtlola_interpreter::time::RelativeFloat;
use rtlola_interpreter::{ConfigBuilder, Value};

const PERIOD_NS: u64 = 10_000_000;

fn event(trace: &Trace, row: usize) -> [Value; 5] {
    let number = |value: f64| Value::try_from(value).expect("the trace is finite");
    [
        number(trace.speed[row]),
        number(trace.pitch[row]),
        number(trace.distance[row]),
        number(trace.force_z[row]),
        Value::Bool(trace.contact[row] != 0),
    ]
}

/// The rule (0, 1 or 2) of an output stream such as `r1_7`; none for other streams.
fn rule(name: &str) -> Option<usize> {
    let number = name.strip_prefix('r')?.split('_').next()?;
    number.parse::<usize>().ok().map(|rule| rule - 1)
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |index: usize| arguments[index].parse::<usize>().expect("a number");
    let (samples, rounds) = (number(3), number(4));
    let trace = Trace::load(Path::new(&arguments[1]), samples);
    let specification = std::fs::read_to_string(&arguments[2]).expect("a specification");
    let mut seconds = Vec::new();
    let mut counts = [0; 3];
    for _ in 0..rounds {
        let mut monitor: Monitor<_, _, Incremental, _> = ConfigBuilder::new()
            .spec_str(&specification)
            .offline::<RelativeFloat>()
            .with_array_events::<5, Infallible, [Value; 5]>()
            .with_verdict::<Incremental>()
            .monitor()
            .expect("the specification is correct");
        let rules: Vec<Option<usize>> =
            monitor.ir().outputs.iter().map(|output| rule(&output.name)).collect();
        counts = [0; 3];
        let start = cpu_seconds();
        for row in 0..samples {
            let at = Duration::from_nanos(row as u64 * PERIOD_NS);
            let verdicts = monitor.accept_event(event(&trace, row), at).expect("accepted");
            for (output, changes) in verdicts.event.iter() {
                let Some(Some(rule)) = rules.get(*output) else { continue };
                for change in changes {
                    if let Change::Value(_, Value::Bool(true)) = change {
                        counts[*rule] += 1;
                    }
                }
            }
        }
        seconds.push(cpu_seconds() - start);
    }
    report(seconds, samples, counts);
}
