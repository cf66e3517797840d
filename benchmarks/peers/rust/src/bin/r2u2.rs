//! R2U2's core on a compiled specification: r2u2 TRACE_FOLDER SPEC.bin SAMPLES RULES ROUNDS

use std::path::Path;

use peers::{cpu_seconds, report, Trace};

fn main() {
    // The monitor is a large value that is built on the stack.
    let worker = std::thread::Builder::new().stack_size(512 << 20).spawn(measure);
    worker.expect("a thread").join().expect("no panic");
}

fn measure() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |index: usize| arguments[index].parse::<usize>().expect("a number");
    let (samples, rules, rounds) = (number(3), number(4), number(5));
    let trace = Trace::load(Path::new(&arguments[1]), samples);
    let specification = std::fs::read(&arguments[2]).expect("a compiled specification");
    let mut seconds = Vec::new();
    let mut counts = [0; 3];
    for _ in 0..rounds {
        let mut monitor = Box::new(r2u2_core::get_monitor(&specification));
        let mut last = vec![-1_i64; rules];
        counts = [0; 3];
        let start = cpu_seconds();
        for row in 0..samples {
            r2u2_core::load_float_signal(&mut monitor, 0, trace.speed[row]);
            r2u2_core::load_float_signal(&mut monitor, 1, trace.pitch[row]);
            r2u2_core::load_float_signal(&mut monitor, 2, trace.distance[row]);
            r2u2_core::load_float_signal(&mut monitor, 3, trace.force_z[row]);
            r2u2_core::load_bool_signal(&mut monitor, 4, trace.contact[row] != 0);
            r2u2_core::monitor_step(&mut monitor);
            // A verdict covers all samples since the verdict before.
            for output in r2u2_core::get_output_buffer(&monitor) {
                let rule = output.spec_num as usize;
                let time = i64::from(output.verdict.time);
                if output.verdict.truth {
                    counts[rule % 3] += (time - last[rule]) as u64;
                }
                last[rule] = time;
            }
        }
        seconds.push(cpu_seconds() - start);
    }
    report(seconds, samples, counts);
}
