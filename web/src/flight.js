// Stores a flight, which arrives as lines (view/story.hpp), in the form that scene and charts draw (page_data.cpp), and
// answers what its state was at any time. A live flight and a finished one arrive in the same form.
import {makeSayings} from './activity.js';
import {makeCustody} from './custody.js';
import {recordFault} from './hand_faults.js';
import {kMostLinks, kMostPoses, kMostSteps, thin, thinEvents, thinSpans} from './history.js';
import {indexAt} from './page.js';
import {poseOn} from './poses.js';

const kSlow = 0.1;          // m/s
const kWorkedFor = 5;       // s; a UAV counts as working for this long after a capture
const kOneGo = 5;          // s; deliveries with shorter gaps become one event
const kOpenEnd = 1e9;       // s; end of a span that has not ended

export const kLinks = ['blocked', 'linked', 'cut by a fault', 'dead'];

/**
 * @param data  the flight fills it for scene and charts.
 * @returns the functions of a flight. They number the UAVs of its own fleet.
 */
export function makeFlight(data) {
  const links = {t: [], l: []};      // times [s]; digits of kLinks
  const counted = {t: [], n: [], s: []};
  const early = [];                  // deliveries that arrive before their captures, from a station's journal
  const events = [];
  const failures = [];               // faults, as recordFault() stores them
  const sayings = makeSayings();
  const {beginPoints, expect, expected, take: takeCapture, deliver, lookUpAll, custody, tallyAt, changedPoints, kept} = makeCustody(data);
  const saidAt = sayings.at;

  /** Fills the data of scene and charts with a flight of which only the scene is known. */
  function begin(scene) {
    Object.assign(data, scene);
    data.end = 0;
    data.delivered = {t: [0], v: [0]};
    data.earned = {t: [0], v: [0]};
    data.best = [];
    for (const uav of data.uavs) {
      uav.track = {grows: true, thinned: 0, t: [], x: [], y: [], z: [], yaw: [], pitch: [], alive: [], speed: []};
      uav.captures = [];
      uav.waiting = {t: [], v: []};
      uav.still = [];
      uav.direct = [];
      uav.relayed = [];
      uav.collided = null;
      uav.undelivered = 0;
      uav.worked = -Infinity;
      uav.voided = Infinity;
      uav.presence = {t: [], there: []};
    }
    beginPoints(data.points.length / 9);
    data.custody = custody;
    data.changedPoints = changedPoints;
    data.linksAt = linksAt;
    data.poseAt = poseAt;
    data.saidAt = saidAt;
    data.saidBy = sayings.of;
    data.failures = failures;
  }

  /** Begins or ends the last span: from this time on, the state is `on`. */
  function mark(spans, time, on) {
    const open = spans.length > 0 && spans.at(-1) === kOpenEnd;
    if (on && !open) spans.push(time, kOpenEnd);
    if (!on && open) spans[spans.length - 1] = time;
    thinSpans(spans);
  }

  function add(curve, time, value) {
    curve.t.push(Math.round(time * 1000));
    curve.v.push(value);
    thin([curve.t, curve.v], kMostSteps);
  }

  /** Updates the curve of the score earned: the score if all captures were delivered. */
  const earn = (time) => {
    const {earned} = tallyAt(Infinity);
    if (Math.round(1000 * earned) !== data.earned.v.at(-1)) add(data.earned, time, Math.round(1000 * earned));
  };

  /** @returns false if the capture has not arrived yet. */
  function delivered(time, u, number) {
    if (!deliver(time, u, number)) return false;
    add(data.uavs[u].waiting, time, --data.uavs[u].undelivered);
    const uav = data.uavs[u];
    // Deliveries in quick succession are one event.
    if (uav.handedOver !== undefined && time - uav.handedOver.until < kOneGo) {
      ++uav.handedOver.object;
      uav.handedOver.until = time;
    } else {
      uav.handedOver = {time, until: time, event: 'delivered', subject: uav.name, object: 1};
      events.push(uav.handedOver);
      thinEvents(events);
    }
    return true;
  }

  const take = {
    activity: sayings.take,
    fault: (line) => recordFault(failures, line),
    estimate: expect,
    pose({t, u}) {
      u.forEach(([x, y, z, yaw, pitch, alive], i) => {
        const uav = data.uavs[i];
        const track = uav.track;
        const at = track.t.length - 1;
        const [px, py, pz] = [x / 100, y / 100, z / 100];
        const passed = at < 0 ? 0 : t - track.t[at];
        const speed = passed > 0 ? Math.hypot(px - track.x[at], py - track.y[at], pz - track.z[at]) / passed : 0;
        track.t.push(t);
        track.x.push(px);
        track.y.push(py);
        track.z.push(pz);
        track.yaw.push(yaw / 1000);
        track.pitch.push(pitch / 1000);
        track.alive.push(alive);
        track.speed.push(speed);
        mark(uav.still, t, alive === 1 && speed < kSlow && t - uav.worked > kWorkedFor);
        if (thin([track.t, track.x, track.y, track.z, track.yaw, track.pitch, track.alive, track.speed], kMostPoses))
          ++track.thinned;
      });
    },
    links({t, l}) {
      links.t.push(t);
      links.l.push(l);
      thin([links.t, links.l], kMostLinks);
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
      thinEvents(events);
      const uav = data.uavs.find(({name}) => name === s);
      if (uav === undefined) return;
      if (e === 'joined' || e === 'left') {
        uav.presence.t.push(t);
        uav.presence.there.push(e === 'joined');
      }
      if (e !== 'collision') return;
      uav.collided = t;
      for (const spans of [uav.still, uav.direct, uav.relayed]) mark(spans, t, false);
    },
    capture(line) {
      const {t, u} = line;
      takeCapture(line);
      const uav = data.uavs[u];
      uav.worked = t;
      const second = Math.floor(t);
      while (uav.captures.length <= second) uav.captures.push(0);
      ++uav.captures[second];
      add(uav.waiting, t, ++uav.undelivered);
      earn(t);
    },
    delivered({t, d}) {
      for (let i = 0; i + 1 < d.length; i += 2)
        if (!delivered(t, d[i], d[i + 1])) early.push([t, d[i], d[i + 1]]);
    },
    void({t, u}) {
      data.uavs[u].voided = Math.min(t, data.uavs[u].voided);
      lookUpAll();
      earn(t);
    },
    score({t, n, s}) {
      counted.t.push(t);
      counted.n.push(n);
      counted.s.push(s);
      thin([counted.t, counted.n, counted.s], kMostSteps);
      add(data.delivered, t, Math.round(1000 * s));
    },
  };

  /** Takes lines. Unknown kinds, such as those of a later version, are ignored. */
  function tell(lines) {
    for (const line of lines) {
      while (early.length > 0 && line.k === 'capture' && early[0][0] <= line.t)
        delivered(...early.shift());
      take[line.k]?.(line);
      data.end = Math.max(data.end, line.t ?? 0);
    }
    // No capture need follow the last deliveries of a restarted station. A batch that ends with a capture may be cut
    // off between captures: a delivery that was later than the next of them would come too early.
    if (lines.at(-1)?.k === 'capture') return;
    while (early.length > 0 && delivered(...early[0])) early.shift();
  }

  /** Takes the newest state of a live flight. */
  function stand(state) {
    data.now = state;
    data.end = Math.max(data.end, state.t);
  }

  /** @returns the links at a time: a digit of kLinks for each, a row for each sender; empty: not known. */
  function linksAt(time) {
    const at = indexAt(links.t, time);
    return at < 0 ? '' : links.l[at];
  }

  const within = (spans, time) => spans.some((begin, i) => i % 2 === 0 && begin <= time && time < spans[i + 1]);

  /** @returns in a word how a UAV is linked to the station. */
  function linkOf(index, time) {
    const {direct, relayed, collided} = data.uavs[index];
    if (collided !== null && collided <= time) return '–';
    if (within(direct, time)) return 'direct';
    if (linksAt(time)[(index + 1) * (data.uavs.length + 1)] === '2') return 'cut';
    return within(relayed, time) ? 'relayed' : 'none';
  }

  /** @returns score and detected points of the station's tally at a time. */
  function scoreAt(time) {
    const at = indexAt(counted.t, time);
    return at < 0 ? {score: 0, points: 0} : {score: counted.s[at], points: counted.n[at]};
  }

  /**
   * @returns position of a UAV and direction of its view, interpolated; null: not known.
   * @param newest  the newest pose.
   */
  function poseAt(index, time, newest) {
    const {track} = data.uavs[index];
    const at = indexAt(track.t, time);
    const now = data.now?.u[index];
    if (newest && now !== undefined && data.now.t >= (track.t.at(-1) ?? 0) - 1e-6) {
      const [x, y, z, yaw, pitch, alive] = now;
      return {x: x / 100, y: y / 100, z: z / 100, yaw: yaw / 1000, pitch: pitch / 1000, alive: alive === 1, at,
              speed: track.speed.at(-1) ?? 0};
    }
    const pose = poseOn(track, time);
    return pose && {...pose, alive: track.alive[at] === 1, speed: track.speed[pose.next]};
  }

  /** @returns by UAV: its share of the score, and the number of its undelivered captures. */
  function sharesAt(time) {
    const {shares} = tallyAt(time);
    return data.uavs.map(({waiting}, uav) => {
      const at = indexAt(waiting.t, Math.round(time * 1000));
      return {score: Math.max(shares[uav], 0), undelivered: at < 0 ? 0 : waiting.v[at]};
    });
  }

  /**
   * @returns number and score of the points by state, the mean losses of delivered points to blur and resolution, and
   * the number of points photographed too poorly, by what lowers their quality most.
   */
  function pointsAt(time) {
    const {states: exact, blur, resolution, poor} = tallyAt(time);
    // After additions and subtractions, the sum over no points is not exactly 0.
    const states = Object.fromEntries(Object.entries(exact).map(
        ([name, {points, score}]) => [name, {points, score: points === 0 ? 0 : score}]));
    const {points} = states.delivered;
    return {states, poor, blur: points > 0 ? blur / points : 0, resolution: points > 0 ? resolution / points : 0};
  }

  /** @returns attainable score, losses by cause, and delivered score; null: the attainable score is not known. */
  function lossesAt(time) {
    const could = expected();
    if (could === null) return null;
    const {losses, states} = tallyAt(time);
    return {could, losses, delivered: states.delivered};
  }

  /** @returns a UAV's activity in words: as it reports it, else derived from its motion. */
  function doing(index, time) {
    const uav = data.uavs[index];
    if (uav.collided !== null && uav.collided <= time) return 'collided';
    const at = indexAt(uav.presence.t, time);
    if (at >= 0 && !uav.presence.there[at]) return 'program lost';
    const said = saidAt(index, time);
    if (said !== null) return said.mode;
    const pose = poseAt(index, time, time >= data.end);
    if (pose === null) return 'not there yet';
    const seconds = uav.captures.slice(Math.max(0, Math.floor(time) - 3), Math.floor(time) + 1);
    if (seconds.some((count) => count > 0)) return pose.speed < 0.3 ? 'photographs' : 'photographs, moving';
    if (pose.speed >= 0.3) return 'flies';
    return pose.z < 1 ? 'on the ground' : 'hovers';
  }

  return {
    data, events, failures, begin, tell, stand, custody, linksAt, linkOf, scoreAt, poseAt, saidAt, saidBy: sayings.of, sharesAt, pointsAt, lossesAt, doing, kept,
  };
}
