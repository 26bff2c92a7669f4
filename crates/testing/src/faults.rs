//! Runs of a program in which one call of the system fails.

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

use crate::program::{Program, contents, given, holds};

/// Calls that can fail, as `faults.c` names them, and the errors they fail with: input or output, disk full, half a
/// write (0), no memory.
const KINDS: [(&str, &[i32]); 6] = [
    ("write", &[EIO, ENOSPC, 0]),
    ("sync", &[EIO, ENOSPC]),
    ("rename", &[EIO, ENOSPC]),
    ("create", &[EIO, ENOSPC]),
    ("length", &[EIO]),
    ("alloc", &[ENOMEM]),
];
const EIO: i32 = 5;
const ENOMEM: i32 = 12;
const ENOSPC: i32 = 28;
/// How a program ends where no memory is left: SIGABRT.
const ABORTED: i32 = 134;

/// A run, and what it left.
struct Run {
    code: i32,
    said: String,
}

impl Program {
    /// Lets one call fail in each of many runs of a job that writes into the folder `out`: the run is as it would be
    /// without the fault, or it says why not with exit code 1, leaves no file but whole ones and that of the name `kept`, and is completed by
    /// `--resume` (with `resumes`) or by the next run, to the same bytes. Only where an allocation fails may it end at
    /// once. So many faults, or `SOFTSTOP_FAULTS`, of a seed or `SOFTSTOP_FAULTS_SEED`; `folder` is
    /// empty. Without a C compiler nothing is done.
    ///
    /// # Panics
    /// If it does otherwise.
    #[track_caller]
    pub fn survives_faults(
        &self,
        arguments: &[&str],
        faults: u64,
        folder: &Path,
        resumes: bool,
        kept: &str,
    ) {
        let seed = given("SOFTSTOP_FAULTS_SEED").unwrap_or(2003);
        let line = arguments.concat();
        let seed = line
            .bytes()
            .fold(seed, |seed, byte| seed.wrapping_mul(31) ^ u64::from(byte));
        let mut chance = SplitMix64::seed_from_u64(seed);
        let Some(shim) = compiled(folder) else {
            println!("skipped: there is no C compiler");
            return;
        };
        let work = folder.join("work");
        std::fs::create_dir(&work).expect("a folder");
        let out = work.join("out");
        let counts = folder.join("counts");
        let mut arguments = [arguments, &["--output", "out"]].concat();
        let run = |arguments: &[&str], variables: &[(&str, &str)]| {
            let mut command = self.command(arguments);
            command.env("LD_PRELOAD", &shim).current_dir(&work);
            command.envs(variables.iter().copied());
            let output = command.stdout(Stdio::null()).output();
            let Output { status, stderr, .. } = output.expect("the program starts");
            let said = String::from_utf8_lossy(&stderr).into_owned();
            // A shell's 128 + n where signal n ended it.
            let code = status.code().or(status.signal().map(|signal| 128 + signal));
            Run {
                code: code.unwrap_or(-1),
                said,
            }
        };
        let counted = counts.to_str().expect("UTF-8");
        let first = run(&arguments, &[("SOFTSTOP_FAULT_COUNTS", counted)]);
        assert_eq!(first.code, 0, "{arguments:?}: {}", first.said);
        let whole = contents(&out);
        let calls = numbers(&counts);
        if resumes {
            arguments.push("--resume");
        }
        let mut ends = BTreeMap::new();
        for _ in 0..given("SOFTSTOP_FAULTS").unwrap_or(faults) {
            let _ = std::fs::remove_dir_all(&out);
            let fault = loop {
                let mut below = |limit: usize| (chance.next_u64() % limit as u64) as usize;
                let (kind, errors) = KINDS[below(KINDS.len())];
                let number = calls[kind];
                if number > 0 {
                    let error = errors[below(errors.len())];
                    break format!("{kind} {} {error} {}", 1 + below(number), below(2));
                }
            };
            let what = format!("{arguments:?} with fault {fault}");
            let Run { code, said } = run(&arguments, &[("SOFTSTOP_FAULT", &fault)]);
            *ends
                .entry((fault[..fault.find(' ').expect("words")].to_owned(), code))
                .or_insert(0) += 1;
            let is_alloc = fault.starts_with("alloc");
            match code {
                0 => holds(&out, &whole, &format!("{what}: {said}")),
                1 => {
                    assert!(said.contains("error"), "{what}: {said}");
                    assert!(!said.contains("panicked"), "{what}: {said}");
                    for (left, content) in contents(&out) {
                        let name = left.file_name().expect("a name").to_string_lossy();
                        let is_whole = whole.get(&left) == Some(&content);
                        let place = left.display();
                        assert!(is_whole || kept == name, "{what}: {place} is left");
                    }
                }
                ABORTED if is_alloc => {}
                _ => panic!("{what}: exit code {code}: {said}"),
            }
            if code != 0 {
                let Run { code, said } = run(&arguments, &[]);
                assert_eq!(code, 0, "after {what}: {said}");
                holds(&out, &whole, &format!("after {what}"));
            }
        }
        println!("{arguments:?}: calls {calls:?}, ends {ends:?}");
    }
}

/// `faults.c` as a library; none without a C compiler.
fn compiled(folder: &Path) -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("faults.c");
    let library = folder.join("faults.so");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let mut command = Command::new(compiler);
    command.args(["-std=c11", "-O2", "-Wall", "-Wextra", "-Werror"]);
    command.args(["-shared", "-fPIC", "-ldl", "-o"]);
    let status = command.arg(&library).arg(source).status().ok()?;
    assert!(status.success(), "{command:?}: {status}");
    Some(library)
}

/// How often each kind of call was made.
fn numbers(path: &Path) -> BTreeMap<String, usize> {
    let text = std::fs::read_to_string(path).expect("counts");
    let pairs = text.lines().filter_map(|line| line.split_once(' '));
    let pairs = pairs.map(|(name, number)| (name.to_owned(), number.parse().expect("a number")));
    pairs.collect()
}
