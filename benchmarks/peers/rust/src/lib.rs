//! The trace, the CPU time, and the line of JSON that each peer prints.

use std::fs;
use std::path::Path;

/// The columns of the workload, one value per sample.
pub struct Trace {
    pub speed: Vec<f64>,
    pub pitch: Vec<f64>,
    pub distance: Vec<f64>,
    pub force_z: Vec<f64>,
    pub contact: Vec<u8>,
}

impl Trace {
    /// Reads the first `samples` rows of the columns in `folder`.
    pub fn load(folder: &Path, samples: usize) -> Trace {
        let column = |name: &str| read(folder, name, samples);
        let mut contact = fs::read(folder.join("contact.u8")).expect("the trace is there");
        contact.truncate(samples);
        Trace {
            speed: column("speed"),
            pitch: column("pitch"),
            distance: column("distance"),
            force_z: column("force_z"),
            contact,
        }
    }
}

fn read(folder: &Path, name: &str, samples: usize) -> Vec<f64> {
    let bytes = fs::read(folder.join(format!("{name}.f64"))).expect("the trace is there");
    bytes
        .chunks_exact(8)
        .take(samples)
        .map(|chunk| f64::from_le_bytes(chunk.try_into().expect("eight bytes")))
        .collect()
}

/// The CPU time of this process so far (s).
pub fn cpu_seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `time` is a valid place to write to, and the clock exists on every POSIX system.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) };
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Prints the median over `seconds` as nanoseconds per sample, and the counts.
pub fn report(mut seconds: Vec<f64>, samples: usize, counts: [u64; 3]) {
    seconds.sort_by(f64::total_cmp);
    let nanoseconds = seconds[seconds.len() / 2] / samples as f64 * 1e9;
    println!("{{\"nanoseconds\": {nanoseconds:.2}, \"counts\": {counts:?}}}");
}
