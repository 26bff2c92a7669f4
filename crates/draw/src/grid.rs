//! Tracks of a grid: columns from left to right, or rows from above.

/// Room between parts of a chart.
pub(crate) const GAP: f64 = 14.0;

/// What stands in one track or more.
pub(crate) struct Item {
    /// The first track, and how many.
    pub(crate) tracks: (usize, usize),
    /// Its size, or its weight if the room is given.
    pub(crate) size: f64,
    /// Room that it needs before and behind.
    pub(crate) room: [f64; 2],
}

/// Begin and size of each item, and the end of the last track; they fill the length, if it is given.
pub(crate) fn arrange(items: &[Item], length: Option<f64>) -> (Vec<(f64, f64)>, f64) {
    let ends = items.iter().map(|it| it.tracks.0 + it.tracks.1);
    let tracks = (0..ends.max().unwrap_or(0)).map(|track| measure(items, track));
    let tracks: Vec<[f64; 3]> = tracks.collect();
    let gaps = GAP * tracks.len().saturating_sub(1) as f64;
    let rooms: f64 = tracks.iter().map(|it| it[0] + it[2]).sum();
    let whole: f64 = tracks.iter().map(|it| it[1]).sum();
    let scale = length.map_or(1.0, |length| ((length - gaps - rooms) / whole).max(0.05));
    let (mut end, mut places) = (-GAP, Vec::new());
    for [before, size, behind] in tracks {
        let begin = end + GAP + before;
        places.push((begin, begin + scale * size));
        end = begin + scale * size + behind;
    }
    let place = |it: &Item| {
        let (first, count) = it.tracks;
        let (begin, end) = (places[first].0, places[first + count - 1].1);
        (begin, end - begin)
    };
    (items.iter().map(place).collect(), end.max(0.0))
}

/// Room before a track, its size, and room behind it.
fn measure(items: &[Item], track: usize) -> [f64; 3] {
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max).ceil();
    let begins = items.iter().filter(|it| it.tracks.0 == track);
    let ends = items
        .iter()
        .filter(|it| it.tracks.0 + it.tracks.1 == track + 1);
    let alone = items.iter().filter(|it| it.tracks == (track, 1));
    let sharing = items
        .iter()
        .filter(|it| (it.tracks.0..it.tracks.0 + it.tracks.1).contains(&track));
    let alone = alone.map(|it| it.size).reduce(f64::max);
    let shared = sharing
        .map(|it| it.size / it.tracks.1 as f64)
        .reduce(f64::max);
    [
        most(&mut begins.map(|it| it.room[0])),
        alone.or(shared).unwrap_or(0.0),
        most(&mut ends.map(|it| it.room[1])),
    ]
}
