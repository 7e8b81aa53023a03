// The custody of each interest point: which UAV photographed it with which quality, and which of these captures were
// delivered. Each line of the flight updates the present state; states of the past are looked up in stored captures.

export const kDetected = 0.2;
const kRecords = 40;  // captures of a point that were its best at some time, and are kept only to show the past
const kHistory = 4;  // further captures of a point that are kept only to show the past
const kMore = 6;     // new captures of a point before forget() runs again

/** A point in a capture. Integers take a third of the memory: q in 1/1000000, its parts in 1/1000. */
class Seen {
  constructor(of, q, blur, distance) {
    this.of = of;
    this.its_q = q;
    this.its_blur = blur;
    this.its_distance = distance;
    this.record = false;  // whether it was the point's best capture at any time
    this.stays = 0;       // number of the last call of forget() that kept it
  }
  get q() { return this.its_q / 1000000; }
  get blur() { return this.its_blur / 1000; }
  get res() { return this.its_blur > 0 ? Math.min(this.q / this.blur, 1) : 0; }
  get distance() { return this.its_distance / 1000; }
}

const kRounding = 2e-6;  // of the difference of two numbers that are rounded to 1/1000000
const kUnseen = {delivered: null, taken: null};
/** Of two captures with equal quality, the earlier one counts, as in the station's tally. */
const better = (one, other) => (other === null || other === undefined ? one.its_q > 0 :
    one.its_q > other.its_q || (one.its_q === other.its_q && one.of.time < other.of.time));
const counts = (seen) => seen !== null && seen.q >= kDetected;

/** @returns the part of a point's quality in a capture that lowers it most: 'distance', 'tilt' or 'blur'. */
export function weakestPart({blur, res, distance}) {
  if (blur === 0) return 'blur';  // the resolution cannot be told from the product of both
  const tilt = distance > 0 ? res / distance : 0;
  return distance <= tilt && distance <= blur ? 'distance' : tilt <= blur ? 'tilt' : 'blur';
}

/** @param data  the flight's data: its UAVs, and its end [s]. */
export function makeCustody(data) {
  const bestTaken = [], bestDelivered = [];  // by UAV, only within forget()
  let stamp = 0;
  const open = new Map();      // by UAV and number: captures that are not delivered yet, with the points in them
  const points = [];           // {seen, delivered, taken, lost}: captures, best delivered one, best of all, loss
  let now = null;              // tally of the present state
  let changed = new Set();     // points whose state has changed since the last changedPoints()
  let past = {time: NaN, tally: null};
  let estimate = null;         // by point: attainable quality, and whether a UAV can reach it

  const isVoid = ({uav}) => data.uavs[uav].voided !== Infinity;

  function emptyTally() {
    const state = () => ({points: 0, score: 0});
    return {
      states: {delivered: state(), carried: state(), poor: state(), unseen: state()},
      poor: {distance: 0, tilt: 0, blur: 0},  // numbers of points, by weakestPart()
      blur: 0, resolution: 0, earned: 0, shares: data.uavs.map(() => 0), losses: new Map(),
    };
  }

  /** @returns the best capture of a point by UAVs whose captures do not count because they collided; null: none. */
  function bestVoid(index, time) {
    let best = null;
    for (const one of points[index].seen)
      if (data.uavs[one.of.uav].voided <= time && isVoid(one.of) && one.of.time <= time && better(one, best)) best = one;
    return best;
  }

  /**
   * The difference between the attainable score of a point and its delivered score, and the cause, as in result.json
   * (docs/results.md, Losses). This function never returns the causes that captures do not reveal: below_threshold (such
   * a point counts as never_in_picture), drift, wind and energy.
   * @returns null for a point that has lost nothing, and while the attainable score is not known.
   */
  function lossOf(index, {delivered, taken}, time) {
    if (estimate === null) return null;
    const could = estimate.q[index];
    const score = counts(delivered) ? delivered.q : 0;
    const loss = could - score;
    const isToBlame = (one) => counts(one) && one.q > score && (score === 0 || one.q - score >= could - one.q);
    const cause = () => {
      if (loss < 0) return 'above_estimate';
      if (isToBlame(taken)) return 'not_delivered';
      if (anyVoid() && isToBlame(bestVoid(index, time))) return 'voided';
      if (score > 0) return weakestPart(delivered);
      return estimate.beyond.has(index) ? 'out_of_reach' : 'never_in_picture';
    };
    return Math.abs(loss) < kRounding ? null : {cause: cause(), loss};
  }
  const anyVoid = () => data.uavs.some(({voided}) => voided !== Infinity);

  /** Takes the attainable quality of all points (a line of the kind "estimate", view/story.hpp). */
  function expect({q, no}) {
    let index = 0;
    estimate = {q: Float64Array.from(q, (value) => value / 1000000), beyond: new Set(no.map((more) => (index += more)))};
    estimate.points = estimate.q.reduce((sum, value) => sum + (value > 0 ? 1 : 0), 0);
    estimate.score = estimate.q.reduce((sum, value) => sum + value, 0);
    past = {time: NaN, tally: null};
    recount();
  }

  /** Adds the loss of a point to a tally, or subtracts it. @param by  1 or -1. */
  function lose(tally, lost, by) {
    if (lost === null) return;
    const sum = tally.losses.get(lost.cause) ?? {points: 0, score: 0};
    sum.points += by;
    sum.score += by * lost.loss;
    tally.losses.set(lost.cause, sum);
  }

  /** Adds a point to a tally, or subtracts it. @param by  1 or -1. */
  function count(tally, {delivered, taken}, by) {
    const given = counts(delivered);
    const name = given ? 'delivered' : taken === null ? 'unseen' : counts(taken) ? 'carried' : 'poor';
    const state = tally.states[name];
    if (name === 'poor') tally.poor[weakestPart(taken)] += by;
    state.points += by;
    state.score += by * ((given ? delivered : taken)?.q ?? 0);
    if (counts(taken)) tally.earned += by * taken.q;
    if (!given) return;
    tally.blur += by * (1 - delivered.blur);
    tally.resolution += by * (1 - delivered.res);
    tally.shares[delivered.of.uav] += by * delivered.q;
  }

  /** Changes a point, and updates the tally of the present state. */
  function set(index, change) {
    const point = points[index];
    count(now, point, -1);
    lose(now, point.lost, -1);
    change(point);
    point.lost = lossOf(index, point, Infinity);
    count(now, point, 1);
    lose(now, point.lost, 1);
    changed.add(index);
  }

  function beginPoints(number) {
    for (let i = 0; i < number; ++i) points.push({seen: [], delivered: null, taken: null, lost: null});
    recount();
  }

  function recount() {
    now = emptyTally();
    points.forEach((point, index) => {
      point.lost = lossOf(index, point, Infinity);
      count(now, point, 1);
      lose(now, point.lost, 1);
    });
  }

  /**
   * Limits the stored captures of a point. Each UAV's best capture and its best delivered capture stay: with these, the
   * present state stays correct whichever captures are delivered later, and whichever UAVs collide. Others stay to show
   * the past: the latest of those that were the point's best at some time, as many as a point usually has, and a few more.
   */
  function forget(point) {
    ++stamp;
    for (const one of point.seen) {
      const {uav, delivered} = one.of;
      if (better(one, bestTaken[uav])) bestTaken[uav] = one;
      if (delivered !== Infinity && better(one, bestDelivered[uav])) bestDelivered[uav] = one;
    }
    for (const {of: {uav}} of point.seen) {
      for (const list of [bestTaken, bestDelivered]) {
        if (list[uav]) list[uav].stays = stamp;
        list[uav] = null;
      }
    }
    for (const one of [point.delivered, point.taken])
      if (one !== null) one.stays = stamp;
    for (const records of [true, false]) {
      let room = records ? kRecords : kHistory;
      for (let i = point.seen.length - 1; i >= 0 && room > 0; --i) {
        const one = point.seen[i];
        if (one.stays === stamp || one.record !== records) continue;
        one.stays = stamp;
        --room;
      }
    }
    let kept = 0;
    for (const one of point.seen)
      if (one.stays === stamp) point.seen[kept++] = one;
    point.seen.length = kept;
    point.room = kept + kMore;
  }

  /** A UAV took a capture. @param list  by point in it: index minus that of the point before; q, q_blur, q_distance. */
  function take({t, u, c, p: list}) {
    const capture = {uav: u, number: c, time: t, delivered: Infinity};
    const seen = [];
    let index = 0;
    for (let i = 0; i + 3 < list.length; i += 4) {
      index += list[i];
      const point = points[index];
      const one = new Seen(capture, list[i + 1], list[i + 2], list[i + 3]);
      point.seen.push(one);
      seen.push(index, one);
      if (!isVoid(capture) && better(one, point.taken)) {
        one.record = true;
        set(index, (its) => (its.taken = one));
      }
      if (point.seen.length > (point.room ?? kMore)) forget(point);
    }
    open.set(`${u} ${c}`, {capture, seen});
  }

  /** A capture reached the station. @returns false if there is no such capture, or it was delivered before. */
  function deliver(time, uav, number) {
    const key = `${uav} ${number}`;
    const taken = open.get(key);
    if (taken === undefined) return false;
    open.delete(key);
    taken.capture.delivered = time;
    for (let i = 0; i < taken.seen.length; i += 2) {
      const one = taken.seen[i + 1];
      if (isVoid(one.of) || !better(one, points[taken.seen[i]].delivered)) continue;
      one.record = true;
      set(taken.seen[i], (its) => (its.delivered = one));
    }
    return true;
  }

  /** Computes the present state anew. Call it when a UAV's captures no longer count. */
  function lookUpAll() {
    points.forEach((point, index) => {
      Object.assign(point, lookUp(index, Infinity));
      changed.add(index);
    });
    recount();
  }

  function lookUp(index, time) {
    let delivered = null;
    let taken = null;
    for (const one of points[index].seen) {
      const {of} = one;
      if (of.time > time || (time === Infinity ? isVoid(of) : time >= data.uavs[of.uav].voided)) continue;
      if (of.delivered !== Infinity && of.delivered <= time && better(one, delivered)) delivered = one;
      if (better(one, taken)) taken = one;
    }
    return {delivered, taken};
  }

  /** @returns the state of a point at a time: its best delivered capture, and its best capture; null: none. */
  function custody(index, time) {
    const point = points[index];
    if (time >= data.end) return point;
    return point.seen.length === 0 ? kUnseen : lookUp(index, time);
  }

  /**
   * @returns over all points: number and score by state, score earned, losses by cause, and each UAV's share of the
   * score.
   */
  function tallyAt(time) {
    if (time >= data.end) return now;
    if (past.time !== time) {
      const tally = emptyTally();
      for (let index = 0; index < points.length; ++index) {
        const point = custody(index, time);
        count(tally, point, 1);
        lose(tally, lossOf(index, point, time), 1);
      }
      past = {time, tally};
    }
    return past.tally;
  }

  /** @returns the points whose present state has changed since the last call. */
  function changedPoints() {
    const those = changed;
    changed = new Set();
    return those;
  }

  /** @returns the number of stored captures of all points, for tests of the page's memory. */
  const kept = () => points.reduce((sum, {seen}) => sum + seen.length, 0);

  /** @returns the attainable score of all points, {points, score}; null: not known. */
  const expected = () => estimate;

  return {beginPoints, expect, expected, take, deliver, lookUpAll, custody, tallyAt, changedPoints, kept};
}
