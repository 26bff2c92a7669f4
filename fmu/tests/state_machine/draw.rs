//! How calls are drawn.

use std::ffi::c_int;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use softstop_fmu::library_guid;

use super::calls::{Call, Damage, Null, Point, STATES, StatusOf, Type, UNITS};
use crate::common::{InstantiateArguments, reference};

fn null() -> impl Strategy<Value = Null> {
    prop_oneof![20 => Just(Null::Nothing), 1 => Just(Null::First), 1 => Just(Null::Second)]
}

/// Numbers that no machine has.
fn odd() -> impl Strategy<Value = f64> {
    select(vec![
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        -1.0,
        0.0,
        -0.0,
        5e-324,
        1e300,
        -1e300,
    ])
}

fn any_reference() -> impl Strategy<Value = u32> {
    let known = softstop_fmu::table().rows().map(|v| v.reference);
    prop_oneof![
        8 => select(known.collect::<Vec<_>>()),
        1 => select(vec![99, 105, 255, 256, 4711, u32::MAX]),
    ]
}

/// A real variable with a value that a machine may have.
fn sound_real() -> impl Strategy<Value = (u32, f64)> {
    let values: [(&str, &[f64]); 16] = [
        ("force", &[0.0, 0.5, -0.5, 3.0]),
        ("base.acceleration", &[0.0, 0.2, -0.4]),
        ("drive.speed", &[0.0, 1.15, -0.7, 2.3]),
        ("drive.amplitude", &[0.0, 1.0, -0.5]),
        ("clearance", &[10.0, 9.0, 4.0, 0.0]),
        ("excitation.amplitude", &[1.0, 1.2, 0.0]),
        ("excitation.frequency", &[1.15, 0.7, 2.3]),
        ("stop.stiffness", &[7.0, 20.0, 0.0]),
        ("stop.preload", &[70.0, 0.0, 35.0]),
        ("mass", &[1.0, 2.0]),
        ("damping", &[0.04, 0.4]),
        ("piercing.thickness", &[0.4, 0.0]),
        ("piercing.travel", &[0.5, 0.0]),
        ("initial.position", &[5.0, 10.2, 12.0, 17.0]),
        ("initial.velocity", &[9.5, 0.0, -9.5]),
        ("stop.loading.from[2]", &[0.0, 0.5]),
    ];
    let pairs = values
        .iter()
        .flat_map(|(name, values)| values.iter().map(|value| (reference(name), *value)));
    select(pairs.collect::<Vec<_>>())
}

fn sound_integer() -> impl Strategy<Value = (u32, f64)> {
    prop_oneof![
        (Just(reference("stop.model")), (1..=6).prop_map(f64::from)),
        (
            Just(reference("stop.loading.count")),
            (1..=3).prop_map(f64::from)
        ),
        (Just(reference("stop.release")), (1..=2).prop_map(f64::from)),
    ]
}

fn boolean() -> impl Strategy<Value = (u32, f64)> {
    let names = [
        "material",
        "rigid.present",
        "drive.takes.speed",
        "drive.takes.amplitude",
    ];
    (
        select(names.map(reference).to_vec()),
        select(vec![0.0, 1.0, -1.0, 77.0]),
    )
}

fn set() -> impl Strategy<Value = Call> {
    // Wild values only where they are refused: those that are not would cost their time.
    let odd_real = (sound_real(), odd()).prop_map(|((reference, _), value)| {
        let refused = !value.is_finite() || value.abs() > 1e12;
        (reference, if refused { value } else { f64::NAN })
    });
    let odd_integer = (sound_integer(), select(vec![-1.0, 10.0, 2147483647.0]))
        .prop_map(|((reference, _), value)| (reference, value));
    let not_settable = (any_reference(), Just(f64::NAN));
    prop_oneof![
        10 => (vec(sound_real(), 0..4), null()).prop_map(|(v, n)| Call::Set(Type::Real, v, n)),
        2 => (vec(prop_oneof![sound_real(), odd_real], 1..4), null())
            .prop_map(|(v, n)| Call::Set(Type::Real, v, n)),
        1 => (vec(not_settable, 1..3), null()).prop_map(|(v, n)| Call::Set(Type::Real, v, n)),
        4 => (vec(sound_integer(), 0..3), null()).prop_map(|(v, n)| Call::Set(Type::Integer, v, n)),
        1 => (vec(prop_oneof![sound_integer(), odd_integer, boolean()], 1..3), null())
            .prop_map(|(v, n)| Call::Set(Type::Integer, v, n)),
        3 => (vec(boolean(), 0..3), null()).prop_map(|(v, n)| Call::Set(Type::Boolean, v, n)),
        1 => (vec(prop_oneof![boolean(), sound_real()], 1..3), null())
            .prop_map(|(v, n)| Call::Set(Type::Boolean, v, n)),
        1 => (vec(sound_real(), 0..2), null()).prop_map(|(v, n)| Call::Set(Type::String, v, n)),
    ]
}

fn get() -> impl Strategy<Value = Call> {
    let kinds = select(vec![Type::Real, Type::Integer, Type::Boolean, Type::String]);
    let reals = select(vec![reference("position"), 207, 210, reference("force"), 0]);
    prop_oneof![
        (kinds, vec(any_reference(), 0..4), null()).prop_map(|(k, v, n)| Call::Get(k, v, n)),
        (vec(reals, 1..4), null()).prop_map(|(v, n)| Call::Get(Type::Real, v, n)),
    ]
}

fn derivatives() -> impl Strategy<Value = Call> {
    let output = select((200u32..=224).collect::<Vec<_>>());
    let known = select(
        [
            "force",
            "base.acceleration",
            "drive.speed",
            "drive.amplitude",
            "initial.position",
            "initial.velocity",
            "mass",
            "clearance",
            "phase",
        ]
        .map(reference)
        .to_vec(),
    );
    let seed = prop_oneof![8 => select(vec![1.0, -0.5, 0.0]), 1 => odd()];
    let rate = prop_oneof![8 => select(vec![0.0, 0.1, -0.2]), 1 => Just(f64::NAN)];
    // A drive that swings up over a long step would cost its time.
    let drive = ["drive.speed", "drive.amplitude"].map(reference);
    let wild = any_reference().prop_filter("no ramps of the drive", move |vr| !drive.contains(vr));
    let inputs = ["force", "base.acceleration"].map(reference).to_vec();
    let input = prop_oneof![8 => select(inputs), 1 => wild];
    let orders = || prop_oneof![8 => Just(1), 2 => Just(2), 1 => select(vec![0, -1, 3, i32::MAX])];
    prop_oneof![
        (vec(output.clone(), 0..3), vec((known, seed), 0..3), null())
            .prop_map(|(u, k, n)| Call::Directional(u, k, n)),
        (vec((input, orders(), rate), 0..3), null())
            .prop_map(|(v, n)| Call::SetInputDerivatives(v, n)),
        (vec((output, orders()), 0..3), null()).prop_map(|(v, n)| Call::GetOutputDerivatives(v, n)),
    ]
}

fn states() -> impl Strategy<Value = Call> {
    let damage = prop_oneof![
        4 => Just(Damage::Nothing),
        1 => Just(Damage::ZerosBehind),
        1 => Just(Damage::Behind),
        1 => any::<usize>().prop_map(Damage::Cut),
        2 => any::<usize>().prop_map(Damage::Bit),
        1 => select(vec![Damage::Empty, Damage::NullBytes, Damage::NullState]),
    ];
    prop_oneof![
        4 => (0..STATES, null()).prop_map(|(s, n)| Call::GetState(s, n)),
        4 => (0..STATES).prop_map(Call::SetState),
        1 => (0..STATES, null()).prop_map(|(s, n)| Call::FreeState(s, n)),
        1 => (0..STATES, null()).prop_map(|(s, n)| Call::SerializedSize(s, n)),
        1 => (0..STATES, select(vec![-1isize, 0, 7, -40]), null())
            .prop_map(|(s, d, n)| Call::Serialize(s, d, n)),
        3 => (0..STATES, damage).prop_map(|(s, d)| Call::DeSerialize(s, d)),
    ]
}

fn step() -> impl Strategy<Value = Call> {
    let point = prop_oneof![
        20 => Just(Point::Present),
        4 => Just(Point::Rounded),
        2 => Just(Point::Counted),
        1 => Just(Point::Previous),
        1 => Just(Point::Beyond),
        1 => odd().prop_map(Point::Number),
    ];
    let size = prop_oneof![
        12 => select(vec![1e-3, 0.1, 0.7, 5.463639, 30.0]),
        1 => select(vec![f64::MIN_POSITIVE, 1e-10]),
        1 => odd(),
    ];
    (point, size).prop_map(|(p, s)| Call::DoStep(p, s))
}

fn arguments() -> impl Strategy<Value = Call> {
    let names = prop_oneof![18 => Just(Some(c"unit")), 1 => Just(None), 1 => Just(Some(c""))];
    let kinds = prop_oneof![18 => Just(1), 1 => select(vec![0, 2, -1, c_int::MAX])];
    let guids = prop_oneof![
        18 => Just(Some(library_guid())),
        1 => select(vec![None, Some("{other}".to_owned())]),
    ];
    let usually = || proptest::bool::weighted(0.9);
    let parts = (names, kinds, guids, usually(), usually(), any::<bool>());
    parts.prop_map(
        |(name, kind, guid, has_callbacks, has_logger, logging_on)| {
            Call::Instantiate(InstantiateArguments {
                name,
                kind,
                guid,
                has_callbacks,
                has_logger,
                logging_on,
            })
        },
    )
}

fn life() -> impl Strategy<Value = Call> {
    let time = || prop_oneof![8 => select(vec![0.0, -5.0, 1e6]), 1 => odd()];
    let start = prop_oneof![8 => select(vec![0.0, 10.0, -5.0]), 1 => Just(f64::NAN)];
    let names = vec(
        select(vec![
            "events",
            "warnings",
            "errors",
            "logEvents",
            "logStatusError",
            "logAll",
            "nonsense",
            "",
            "logStatusPending",
            "NULL",
        ]),
        0..3,
    );
    let status = select(vec![
        StatusOf::Step,
        StatusOf::Real,
        StatusOf::Integer,
        StatusOf::Boolean,
        StatusOf::String,
    ]);
    let kinds = prop_oneof![6 => 0..4, 1 => select(vec![-1, 4, c_int::MIN, c_int::MAX])];
    prop_oneof![
        1 => Just(Call::Texts),
        2 => Just(Call::FreeInstance),
        3 => (any::<c_int>(), names, null()).prop_map(|(o, v, n)| Call::SetDebugLogging(o, v, n)),
        12 => (proptest::option::of(time()), start, proptest::option::of(time()))
            .prop_map(|(t, s, e)| Call::SetupExperiment(t, s, e)),
        14 => Just(Call::EnterInitializationMode),
        14 => Just(Call::ExitInitializationMode),
        1 => Just(Call::Terminate),
        2 => Just(Call::Reset),
        1 => Just(Call::CancelStep),
        5 => (status, kinds, null()).prop_map(|(f, k, n)| Call::Status(f, k, n)),
    ]
}

type Sequence = Vec<(usize, Call)>;

/// Any call on an instance; the one numbered `UNITS` does not exist.
pub fn any_call() -> impl Strategy<Value = (usize, Call)> {
    let call = prop_oneof![
        2 => arguments(),
        6 => life(),
        4 => set(),
        3 => get(),
        2 => derivatives(),
        3 => states(),
        8 => step(),
    ];
    let unit = prop_oneof![8 => Just(0), 3 => Just(1), 1 => Just(2), 1 => Just(UNITS)];
    (unit, call)
}

/// A life of the first instance, with mistakes on the way, and then anything.
fn lifelike() -> impl Strategy<Value = Sequence> {
    let values = || prop_oneof![3 => set(), 2 => get(), 1 => derivatives(), 1 => states()];
    let running = || prop_oneof![3 => values(), 4 => step()];
    let parts = (
        vec(values(), 0..5),
        select(vec![0.0, 10.0, -5.0]),
        vec(values(), 0..8),
        vec(running(), 0..20),
        vec(any_call(), 0..40),
    );
    parts.prop_map(|(before, start, within, running, rest)| {
        let setup = Call::SetupExperiment(None, start, None);
        let calls = before
            .into_iter()
            .chain([setup, Call::EnterInitializationMode])
            .chain(within)
            .chain([Call::ExitInitializationMode])
            .chain(running);
        calls.map(|call| (0, call)).chain(rest).collect()
    })
}

/// A sequence of calls, each with the number of its instance.
pub fn sequence() -> impl Strategy<Value = Sequence> {
    prop_oneof![2 => lifelike(), 1 => vec(any_call(), 0..120)]
}
