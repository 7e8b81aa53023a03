// A flight as it is told in lines (view/story.hpp), kept in the form that scene and charts draw (page_data.cpp), and
// what is asked of it at any moment. One that flies and one that is over are told alike.
import {data, indexAt} from './page.js';

const kDetected = 0.2;
const kSlow = 0.1;          // m/s
const kWorkedFor = 5;       // s that a capture counts as work
const kOpenEnd = 1e9;       // of a span that has not ended

export const kLinks = ['blocked', 'linked', 'cut by a fault', 'dead'];

const captures = new Map();        // "uav capture" -> what became of it
const byPoint = [];                // captures that saw a point: {q, ..., of}
const links = {t: [], l: []};      // times, digits
const counted = {t: [], n: [], s: []};
export const events = [];

/** Fills what scene and charts read with a flight of which nothing is known but its scene. */
export function begin(scene) {
  Object.assign(data, scene);
  data.end = 0;
  data.delivered = {t: [0], v: [0]};
  data.earned = {t: [0], v: [0]};
  data.best = [];
  for (const uav of data.uavs) {
    uav.track = {grows: true, t: [], x: [], y: [], z: [], yaw: [], pitch: [], alive: [], speed: []};
    uav.captures = [];
    uav.waiting = {t: [], v: []};
    uav.still = [];
    uav.direct = [];
    uav.relayed = [];
    uav.collided = null;
    uav.undelivered = 0;
    uav.worked = -Infinity;
    uav.voided = Infinity;
  }
  for (let i = 0; i < data.points.length / 9; ++i) byPoint.push([]);
  data.custody = custody;
  data.linksAt = linksAt;
  data.poseAt = poseAt;
}

/** Spans grow at their end: `on` from this time. */
function mark(spans, time, on) {
  const open = spans.length > 0 && spans.at(-1) === kOpenEnd;
  if (on && !open) spans.push(time, kOpenEnd);
  if (!on && open) spans[spans.length - 1] = time;
}

function add(curve, time, value) {
  curve.t.push(Math.round(time * 1000));
  curve.v.push(value);
}

/** A capture that would count if it were delivered. */
const stands = (seen, time) => seen.q >= kDetected && time < data.uavs[seen.of.uav].voided;

function earn(time) {
  let sum = 0;
  for (const seen of byPoint) {
    let best = 0;
    for (const one of seen)
      if (one.q > best && one.of.time <= time && stands(one, time)) best = one.q;
    sum += best;
  }
  add(data.earned, time, Math.round(1000 * sum));
}

const take = {
  pose({t, u}) {
    u.forEach(([x, y, z, yaw, pitch, alive], i) => {
      const uav = data.uavs[i];
      const track = uav.track;
      const at = track.t.length - 1;
      const [px, py, pz] = [x / 100, y / 100, z / 100];
      const passed = at < 0 ? 0 : t - track.t[at];
      const speed = passed > 0 ? Math.hypot(px - track.x[at], py - track.y[at], pz - track.z[at]) / passed : 0;
      for (const [name, value] of Object.entries(
               {t, x: px, y: py, z: pz, yaw: yaw / 1000, pitch: pitch / 1000, alive, speed}))
        track[name].push(value);
      mark(uav.still, t, alive === 1 && speed < kSlow && t - uav.worked > kWorkedFor);
    });
  },
  links({t, l}) {
    links.t.push(t);
    links.l.push(l);
    const nodes = data.uavs.length + 1;
    const open = (from, to) => l[from * nodes + to] === '1';
    const reached = new Set([0]);
    for (const to of reached)
      for (let from = 1; from < nodes; ++from)
        if (open(from, to)) reached.add(from);
    data.uavs.forEach((uav, i) => {
      const direct = open(i + 1, 0);
      mark(uav.direct, t, direct);
      mark(uav.relayed, t, !direct && reached.has(i + 1));
    });
  },
  event({t, e, s, o}) {
    events.push({time: t, event: e, subject: s, object: o});
    const uav = data.uavs.find(({name}) => name === s);
    if (e !== 'collision' || uav === undefined) return;
    uav.collided = t;
    for (const spans of [uav.still, uav.direct, uav.relayed]) mark(spans, t, false);
  },
  capture({t, u, c, p}) {
    const capture = {uav: u, number: c, time: t, delivered: Infinity};
    captures.set(`${u} ${c}`, capture);
    let rise = 0;
    for (const [index, q, blur, res, distance] of p) {
      const best = byPoint[index].reduce((most, one) => (stands(one, t) ? Math.max(most, one.q) : most), 0);
      byPoint[index].push({q, blur, res, distance, of: capture});
      if (q >= kDetected) rise += Math.max(q - best, 0);
    }
    const uav = data.uavs[u];
    uav.worked = t;
    const second = Math.floor(t);
    while (uav.captures.length <= second) uav.captures.push(0);
    ++uav.captures[second];
    add(uav.waiting, t, ++uav.undelivered);
    if (rise > 0) add(data.earned, t, data.earned.v.at(-1) + Math.round(1000 * rise));
  },
  delivered({t, u, c}) {
    const capture = captures.get(`${u} ${c}`);
    if (capture === undefined || capture.delivered !== Infinity) return;
    capture.delivered = t;
    add(data.uavs[u].waiting, t, --data.uavs[u].undelivered);
    const last = events.at(-1);
    if (last?.event === 'delivered' && last.subject === data.uavs[u].name && t - last.time < 5) {
      ++last.object;
      last.until = t;
    } else
      events.push({time: t, event: 'delivered', subject: data.uavs[u].name, object: 1});
  },
  void({t, u}) {
    data.uavs[u].voided = Math.min(t, data.uavs[u].voided);
    earn(t);
  },
  score({t, n, s}) {
    counted.t.push(t);
    counted.n.push(n);
    counted.s.push(s);
    add(data.delivered, t, Math.round(1000 * s));
  },
};

/** Takes lines in; kinds of a later version are passed over. */
export function tell(lines) {
  for (const line of lines) {
    take[line.k]?.(line);
    data.end = Math.max(data.end, line.t ?? 0);
  }
}

/** Takes in how it stands now. */
export function stand(state) {
  data.now = state;
  data.end = Math.max(data.end, state.t);
}

/** What is known of a point at a time: its best capture that was delivered, else the best that was taken. */
export function custody(index, time) {
  let delivered = null;
  let taken = null;
  for (const one of byPoint[index]) {
    if (one.of.time > time || time >= data.uavs[one.of.uav].voided) continue;
    if (one.of.delivered <= time && one.q > (delivered?.q ?? 0)) delivered = one;
    if (one.q > (taken?.q ?? 0)) taken = one;
  }
  return {delivered, taken};
}

/** Digits of kLinks, row by sender; empty before anything is known. */
export function linksAt(time) {
  const at = indexAt(links.t, time);
  return at < 0 ? '' : links.l[at];
}

const within = (spans, time) => spans.some((begin, i) => i % 2 === 0 && begin <= time && time < spans[i + 1]);

/** How a UAV is linked to the station, in a word. */
export function linkOf(index, time) {
  const {direct, relayed, collided} = data.uavs[index];
  if (collided !== null && collided <= time) return '–';
  if (within(direct, time)) return 'direct';
  if (linksAt(time)[(index + 1) * (data.uavs.length + 1)] === '2') return 'cut';
  return within(relayed, time) ? 'relayed' : 'none';
}

/** Of the station's tally. */
export function scoreAt(time) {
  const at = indexAt(counted.t, time);
  return at < 0 ? {score: 0, points: 0} : {score: counted.s[at], points: counted.n[at]};
}

/** The shorter way from one angle to another. */
const turned = (from, to, share) => from + share * Math.atan2(Math.sin(to - from), Math.cos(to - from));

/** Where a UAV is and looks, between the poses of its trail; the newest if that is asked for. null: not known. */
export function poseAt(index, time, newest) {
  const {track} = data.uavs[index];
  const at = indexAt(track.t, time);
  const now = data.now?.u[index];
  if (newest && now !== undefined && data.now.t >= (track.t.at(-1) ?? 0) - 1e-6) {
    const [x, y, z, yaw, pitch, alive] = now;
    return {x: x / 100, y: y / 100, z: z / 100, yaw: yaw / 1000, pitch: pitch / 1000, alive: alive === 1, at,
            speed: track.speed.at(-1) ?? 0};
  }
  if (at < 0) return null;
  const next = Math.min(at + 1, track.t.length - 1);
  const share = next > at ? Math.min((time - track.t[at]) / (track.t[next] - track.t[at]), 1) : 0;
  const between = (values) => values[at] + share * (values[next] - values[at]);
  return {
    x: between(track.x), y: between(track.y), z: between(track.z),
    yaw: turned(track.yaw[at], track.yaw[next], share), pitch: between(track.pitch),
    alive: track.alive[at] === 1, at, speed: track.speed[next],
  };
}

/** By UAV: how much of the score is its, and how many of its captures had not been delivered. */
export function sharesAt(time) {
  const shares = data.uavs.map(({waiting}) => {
    const at = indexAt(waiting.t, Math.round(time * 1000));
    return {score: 0, undelivered: at < 0 ? 0 : waiting.v[at]};
  });
  for (let point = 0; point < byPoint.length; ++point) {
    if (byPoint[point].length === 0) continue;
    const {delivered} = custody(point, time);
    if (delivered !== null && delivered.q >= kDetected) shares[delivered.of.uav].score += delivered.q;
  }
  return shares;
}

/** Where the score is: of all points, how many are in which state, and what they hold. */
export function pointsAt(time) {
  const states = {
    delivered: {points: 0, score: 0},
    carried: {points: 0, score: 0},
    poor: {points: 0, score: 0},
    unseen: {points: 0, score: 0},
  };
  let [blur, resolution] = [0, 0];
  for (let point = 0; point < byPoint.length; ++point) {
    const {delivered, taken} = byPoint[point].length > 0 ? custody(point, time) : {delivered: null, taken: null};
    const counts = delivered !== null && delivered.q >= kDetected;
    const state = counts ? 'delivered' : taken === null ? 'unseen' : taken.q >= kDetected ? 'carried' : 'poor';
    ++states[state].points;
    states[state].score += (counts ? delivered : taken)?.q ?? 0;
    if (!counts) continue;
    blur += 1 - delivered.blur;
    resolution += 1 - delivered.res;
  }
  const {points} = states.delivered;
  return {states, blur: points > 0 ? blur / points : 0, resolution: points > 0 ? resolution / points : 0};
}

/** What a UAV does, in words. */
export function doing(index, time) {
  const uav = data.uavs[index];
  if (uav.collided !== null && uav.collided <= time) return 'collided';
  const present = events.filter((e) => e.subject === uav.name && e.time <= time && ['joined', 'left'].includes(e.event));
  if (present.at(-1)?.event === 'left') return 'program lost';
  const pose = poseAt(index, time, time >= data.end);
  if (pose === null) return 'not there yet';
  const seconds = uav.captures.slice(Math.max(0, Math.floor(time) - 3), Math.floor(time) + 1);
  if (seconds.some((count) => count > 0)) return pose.speed < 0.3 ? 'photographs' : 'photographs on its way';
  if (pose.speed >= 0.3) return 'flies';
  return pose.z < 1 ? 'on the ground' : 'hovers';
}
