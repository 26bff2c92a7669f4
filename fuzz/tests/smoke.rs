//! Each fuzz target on damaged copies of what it reads.

use std::fs;
use std::path::Path;

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use softstop_console::record_log::RecordLog;
use softstop_fuzz::behind_fitting_header;
use softstop_testing::docs;

/// Damages bytes here and there: other bits, other bytes, parts left out, twice or from elsewhere.
fn damage(bytes: &mut Vec<u8>, chance: &mut SplitMix64) {
    let below = |chance: &mut SplitMix64, limit: usize| chance.next_u64() as usize % limit.max(1);
    for _ in 0..1 + below(chance, 4) {
        let (place, length) = (below(chance, bytes.len()), 1 + below(chance, 16));
        let end = (place + length).min(bytes.len());
        match below(chance, 6) {
            0 if end > place => bytes[place] ^= 1 << below(chance, 8),
            1 if end > place => bytes[place] = [0, 0xff, 0x7f, 0x80, b'9', b'-'][below(chance, 6)],
            2 => drop(bytes.drain(place..end)),
            3 => drop(bytes.splice(place..place, bytes[place..end].to_vec())),
            4 => {
                let from = below(chance, bytes.len());
                let part = bytes[from..(from + length).min(bytes.len())].to_vec();
                bytes.splice(place..end, part);
            }
            _ => bytes.truncate(if below(chance, 8) == 0 {
                place
            } else {
                bytes.len()
            }),
        }
    }
}

/// Gives a target whole and damaged copies of seeds: so many, or `SOFTSTOP_FUZZ`.
fn smoke(target: fn(&[u8]), seeds: &[Vec<u8>], count: usize) {
    let given = std::env::var("SOFTSTOP_FUZZ");
    let count = given.ok().and_then(|it| it.parse().ok()).unwrap_or(count);
    seeds.iter().for_each(|seed| target(seed));
    let mut chance = SplitMix64::seed_from_u64(37);
    for _ in 0..count {
        let mut bytes = seeds[chance.next_u64() as usize % seeds.len()].clone();
        damage(&mut bytes, &mut chance);
        target(&bytes);
    }
}

/// The machine files of the guide.
fn machines() -> Vec<Vec<u8>> {
    let entries = fs::read_dir(docs("scenes")).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension() == Some("toml".as_ref()))
        .collect();
    paths.sort();
    let texts = paths.iter().map(|path| fs::read(path).expect("a file"));
    texts.collect()
}

/// What a run of five pieces keeps.
fn kept() -> Vec<Vec<u8>> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.part");
    let file = RecordLog::create(&path, b"a run").expect("a file");
    let mut file = file.expect("no other run");
    for number in 0..5u8 {
        let piece = vec![number; 40 * usize::from(number)];
        file.append(&[number], &piece).expect("a file");
    }
    vec![fs::read(&path).expect("a file")]
}

/// Random bytes: 100 calls each.
fn sequences() -> Vec<Vec<u8>> {
    let mut chance = SplitMix64::seed_from_u64(2003);
    let sequence = |_| {
        let mut bytes = vec![0; 400];
        chance.fill_bytes(&mut bytes);
        bytes
    };
    (0..10).map(sequence).collect()
}

fn states() -> Vec<Vec<u8>> {
    vec![softstop_fuzz::serialized()]
}

#[test]
fn toml() {
    smoke(softstop_fuzz::toml, &machines(), 20_000);
}

#[test]
fn pieces() {
    smoke(softstop_fuzz::pieces, &kept(), 5000);
}

#[test]
fn state() {
    smoke(softstop_fuzz::state, &states(), 5000);
}

#[test]
fn calls() {
    smoke(softstop_fuzz::calls, &sequences(), 1000);
}

/// Writes the seeds for `cargo fuzz`, which adds to them what reaches more code.
#[test]
#[ignore = "writes fuzz/corpus"]
fn corpora() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for (target, seeds) in [
        ("toml", machines()),
        ("pieces", kept()),
        ("state", states()),
        ("calls", sequences()),
    ] {
        let folder = corpus.join(target);
        fs::create_dir_all(&folder).expect("a folder");
        for (number, seed) in seeds.iter().enumerate() {
            fs::write(folder.join(number.to_string()), seed).expect("a file");
        }
    }
}

/// A header that fits is no proof: data that nest without end do not exhaust the stack, where types hold themselves, where the
/// reader must look ahead, and where it skips.
#[test]
fn states_that_nest_without_end_are_refused() {
    /// An array, and maps of one entry, in CBOR (RFC 8949), 3.1.
    const ARRAY: &[u8] = b"\x81";
    const UNIT_MORE: &[u8] = b"\xa1\x64unit\xa1\x64more";
    const ENDED_MORE: &[u8] = b"\xa1\x65ended\xa1\x64more";
    const STOP: &[u8] = b"\xa1\x64unit\xa1\x6asimulation\xa1\x65scene\xa1\x64stop";
    const UNKNOWN: &[u8] = b"\xa1\x67unknown";
    let known = softstop_fuzz::serialized();
    let (head, body) = known.split_at(52);
    let refused = |body: &[u8]| softstop_fuzz::take_up(&behind_fitting_header(head, body)) != 0;
    assert!(!refused(body));
    for (begin, again) in [(UNIT_MORE, ENDED_MORE), (STOP, ARRAY), (UNKNOWN, ARRAY)] {
        let nested = again.repeat(200_000);
        assert!(refused(&[begin, &nested].concat()));
    }
}
