"""Which tolerance a peer needs, and how fast it is with it."""

import math
import statistics
from dataclasses import dataclass, field

from catalogue import PERIODS, SHORT_PERIODS, frequencies, request
from link import PeerError, PeerTimeoutError

GOAL = 1e-9
DECADES = [10.0**-k for k in range(8, 15)]
JUDGED = 32
LEAST_JUDGED, ALIKE = 3, 4
REPEATS, FEWER_REPEATS = 5, 3
LEAST_PATIENCE = 30.0
NUDGE = 1e-8
MOST_GROWTH = 10.0
SCALAR = "exact"


class Truth:
    """softstop's own ends, and at which frequencies they can be compared: where a start NUDGE faster ends
    less than MOST_GROWTH times NUDGE away after as many impacts. Chaos is thereby left out."""

    def __init__(self, worker, periods):
        self.periods = periods
        self.order = frequencies()
        self.worker = worker
        ends = self._solve([0.0, 14.0])
        nudged = self._solve([0.0, 14.0 + NUDGE])
        self.ends = dict(zip(self.order, ends, strict=True))
        self.regular = [
            frequency
            for frequency, end, other in zip(self.order, ends, nudged, strict=True)
            if distance(end, other) < MOST_GROWTH * NUDGE and end[2] == other[2]
        ]
        self.comparable = set(self.regular)

    def _solve(self, start):
        line = request(SCALAR, 0.0, self.periods, self.order, start)
        return self.worker.ask(line, 120.0)[1]

    def compare(self, chosen, ends):
        """The largest and the median error, how many impact counts differ of how many motions compared."""
        pairs = [
            (end, self.ends[frequency])
            for frequency, end in zip(chosen, ends, strict=True)
            if frequency in self.comparable
        ]
        errors = [distance(*pair) for pair in pairs] or [math.nan]
        differing = sum(end[2] != true[2] for end, true in pairs)
        return max(errors), statistics.median(errors), differing, len(pairs)

    def safe_rate(self, chosen):
        """Forcing periods per second of softstop's safe engine on these frequencies."""
        line = request(SCALAR, 0.0, self.periods, chosen)
        rounds = max(REPEATS, 200 // len(chosen))
        times = [self.worker.ask(line, 60.0)[0] for _ in range(rounds)]
        return self.periods * len(chosen) / statistics.median(times)


def distance(end, other):
    """The larger difference of X and X'."""
    error = max(abs(end[0] - other[0]), abs(end[1] - other[1]))
    return error if math.isfinite(error) else math.inf


@dataclass
class Verdict:
    """How a peer does at one tolerance."""

    tolerance: float
    error: float = math.inf
    differing: int = 0
    judged: int = 0
    seconds: float = 0.0
    failure: str = ""
    timed_out: bool = False

    @property
    def reaches(self):
        """Whether it reaches the goal."""
        return not self.failure and self.error <= GOAL and not self.differing


@dataclass
class Result:
    """What was measured of one peer."""

    name: str
    status: str = "measured"
    reason: str = ""
    tolerance: float = math.nan
    periods: int = PERIODS
    trajectories: int = 0
    rates: list = field(default_factory=list)
    error: float = math.nan
    median_error: float = math.nan
    differing: int = 0
    compared: int = 0
    safe_rate: float = math.nan

    @property
    def rate(self):
        """The median of the forcing periods per second."""
        return statistics.median(self.rates) if self.rates else math.nan


class Measurement:
    """One peer against the truth, within a budget of seconds."""

    def __init__(self, method, worker, truths, budget):
        self.method = method
        self.worker = worker
        self.truths = truths
        self.truth = truths[PERIODS]
        self.budget = budget
        self.patience = max(LEAST_PATIENCE, 10.0 * budget)

    def run(self):
        """Finds the tolerance, then measures."""
        result = Result(self.method)
        try:
            self._settle_periods()
            verdict = self._scan()
            result.periods, result.tolerance = self.truth.periods, verdict.tolerance
            if not verdict.reaches:
                result.status = "does not reach 1e-9"
            self._time(result, verdict)
        except PeerError as error:
            result.status, result.reason = "failed", str(error)
        return result

    def _ask(self, tolerance, chosen):
        line = request(self.method, tolerance, self.truth.periods, chosen)
        return self.worker.ask(line, self.patience)

    def _settle_periods(self):
        """A peer that takes long for one motion gets a tenth of the periods. The first answer also
        brings all compilation and import behind us."""
        self.truth = self.truths[SHORT_PERIODS]
        self._ask(1e-9, self.truth.regular[:1])
        seconds, _ = self._ask(1e-9, self.truth.regular[:1])
        if seconds * PERIODS / SHORT_PERIODS < self.budget / 4.0:
            self.truth = self.truths[PERIODS]

    def _scan(self):
        """The largest tolerance that reaches the goal, in half decades; else the best one."""
        verdicts = []
        for tolerance in DECADES:
            verdict = self._judge(tolerance)
            verdicts.append(verdict)
            if verdict.reaches:
                between = self._judge(tolerance * math.sqrt(10.0))
                return between if between.reaches else verdict
            if verdict.timed_out:
                break
        patient = [verdict.tolerance for verdict in verdicts if not verdict.failure]
        if not patient:
            raise PeerError(verdicts[-1].failure)
        # None reaches it: the best one, all judged by the same motions.
        again = [self._judge(tolerance, ALIKE) for tolerance in patient]
        answered = [verdict for verdict in again if not verdict.failure]
        if not answered:
            raise PeerError(again[-1].failure)
        return min(answered, key=lambda verdict: (verdict.differing > 0, verdict.error))

    def _judge(self, tolerance, fixed=0):
        """More and more motions, until one is wrong or the share of the budget is used up; or as many as
        are given."""
        verdict = Verdict(tolerance, error=0.0)
        size, most = fixed or 1, fixed or JUDGED
        while verdict.judged < most and verdict.reaches:
            if verdict.seconds > self.budget / 2.0 and verdict.judged >= LEAST_JUDGED:
                break
            chosen = self.truth.regular[verdict.judged : min(verdict.judged + size, most)]
            try:
                seconds, ends = self._ask(tolerance, chosen)
            except PeerError as error:
                verdict.timed_out = isinstance(error, PeerTimeoutError)
                verdict.failure = str(error)
                break
            error, _, differing, judged = self.truth.compare(chosen, ends)
            verdict.error = max(verdict.error, error)
            verdict.differing += differing
            verdict.judged += judged
            verdict.seconds += seconds
            size *= 2
        return verdict

    def _time(self, result, verdict):
        """The same motions again and again, as many as the budget allows."""
        each = verdict.seconds / verdict.judged
        fitting = int(self.budget / REPEATS / each)
        count = min(max(fitting, LEAST_JUDGED), len(self.truth.order))
        if count > 8:
            count -= count % 8
        # Sorted, so that the lanes of a batch get similar frequencies.
        chosen = sorted(self.truth.order[:count])
        slow = each * count * REPEATS > 3.0 * self.budget
        for _ in range(FEWER_REPEATS if slow else REPEATS):
            seconds, ends = self._ask(verdict.tolerance, chosen)
            result.rates.append(self.truth.periods * count / seconds)
        result.trajectories = count
        compared = self.truth.compare(chosen, ends)
        result.error, result.median_error, result.differing, result.compared = compared
        result.safe_rate = self.truth.safe_rate(chosen)
