// The expected contents of a page's tables, computed a second time from result.json and the tables of the run.
import fs from 'node:fs';
import path from 'node:path';

const number = (text) => (text === '' ? null : Number(text));

export function readRun(dir) {
  const text = (name) => fs.readFileSync(path.join(dir, name), 'utf8');
  const table = (name) => {
    if (!fs.existsSync(path.join(dir, name))) return null;
    const [head, ...lines] = text(name).trimEnd().split('\n').map((line) => line.split(','));
    return lines.map((cells) => Object.fromEntries(head.map((column, i) => [column, cells[i]])));
  };
  return {
    result: JSON.parse(text('result.json')),
    scene: JSON.parse(text('scene.json')),
    score: table('score.csv'),
    losses: table('losses.csv'),
    captures: table('captures.csv'),
    events: table('events.csv'),
    activity: table('activity.csv'),
    trajectories: table('trajectories.csv'),
    map: (uav) => {
      const file = path.join(dir, `map-${uav}.bt`);
      return fs.existsSync(file) ? octree(fs.readFileSync(file)) : null;
    },
  };
}

/** @returns the leaves of a file of OctoMap: [lowest corner [m], edge [m], whether occupied]. */
function octree(bytes) {
  let at = 0;
  let resolution = 0;
  for (let line = ''; line !== 'data';) {
    const end = bytes.indexOf('\n', at);
    line = bytes.toString('latin1', at, end);
    if (line.startsWith('res ')) resolution = Number(line.slice(4));
    at = end + 1;
  }
  const leaves = [];
  const walk = (corner, edge) => {
    const bits = bytes.readUInt16LE(at);
    at += 2;
    const inner = [];
    for (let i = 0; i < 8; ++i) {
      const child = (bits >> (2 * i)) & 3;
      const lowest = corner.map((low, axis) => low + ((i >> axis) & 1) * (edge / 2));
      if (child === 3)
        inner.push(lowest);
      else if (child !== 0)
        leaves.push([lowest, edge / 2, child === 2]);
    }
    for (const lowest of inner) walk(lowest, edge / 2);
  };
  if (at < bytes.length) walk([-1, -1, -1].map((sign) => sign * resolution * 32768), resolution * 65536);
  return leaves;
}

const kCauses = [
  'out_of_reach', 'never_in_picture', 'below_threshold', 'voided', 'not_delivered', 'distance', 'tilt', 'blur',
  'drift', 'wind', 'energy', 'above_estimate'
];

function losses({result}) {
  if (result.losses === null) return null;
  const rows = [[result.attainable.score, 100, result.attainable.points]];
  for (const cause of kCauses) {
    const {points, score} = result.losses[cause];
    if (points > 0) rows.push([-score, (100 * score) / result.attainable.score, points]);
  }
  rows.push([result.score, (100 * result.score) / result.attainable.score, result.points_detected]);
  return rows;
}

function inBox(box, p) {
  return [0, 1, 2].every((axis) => {
    const along = [0, 1, 2].reduce((sum, row) => sum + box.rotation[row][axis] * (p[row] - box.center[row]), 0);
    return Math.abs(along) <= 0.5 * box.size[axis];
  });
}

function boxes({scene, score, losses: lost}) {
  const rows = scene.boxes.map(() => []);
  const outside = [];
  score.forEach((row, index) => {
    const box = scene.boxes.findIndex((candidate) => inBox(candidate, [Number(row.x), Number(row.y), Number(row.z)]));
    (box < 0 ? outside : rows[box]).push(index);
  });
  if (outside.length > 0) rows.push(outside);
  rows.push(score.map((_, index) => index));
  const byIndex = new Map((lost ?? []).map((row) => [Number(row.index), row]));
  const sumOf = (indices, of) => indices.reduce((sum, index) => sum + of(index), 0);
  const taking = kCauses.filter(
      (cause) => sumOf(rows.at(-1), (i) => (byIndex.get(i)?.cause === cause ? Number(byIndex.get(i).loss) : 0)) !== 0);
  return rows.map((indices) => {
    const scored = indices.filter((i) => Number(score[i].score) > 0);
    const total = sumOf(indices, (i) => Number(score[i].score));
    const estimate = sumOf(indices, (i) => Number(byIndex.get(i)?.estimate ?? 0));
    const row = [indices.length, scored.length, scored.length > 0 ? total / scored.length : null, total];
    if (lost === null) return row;
    row.splice(1, 0, indices.filter((i) => Number(byIndex.get(i)?.estimate ?? 0) > 0).length);
    row.push(estimate > 0 ? (100 * total) / estimate : null);
    for (const cause of taking) {
      const sum = sumOf(indices, (i) => (byIndex.get(i)?.cause === cause ? Number(byIndex.get(i).loss) : 0));
      row.push(sum === 0 ? null : sum);
    }
    return row;
  });
}

function maps(run) {
  const kEdge = 2;
  const extents = run.scene.boxes.map((box) => [0, 1, 2].map((axis) => {
    const half = [0, 1, 2].reduce((sum, column) => sum + Math.abs(box.rotation[axis][column]) * 0.5 * box.size[column], 0);
    return [box.center[axis] - half, box.center[axis] + half];
  }));
  const held = (lowest, edge) => {
    const high = lowest.map((low) => low + edge);
    if (!extents.some((extent) => extent.every(([from, to], axis) => high[axis] >= from && lowest[axis] <= to))) return 0;
    if (edge > kEdge) {
      let sum = 0;
      for (let i = 0; i < 8; ++i) sum += held(lowest.map((low, axis) => low + ((i >> axis) & 1) * (edge / 2)), edge / 2);
      return sum;
    }
    return run.scene.boxes.some((box) => inBox(box, lowest.map((low) => low + edge / 2))) ? edge ** 3 : 0;
  };
  const kWorld = 65536;
  const whole = held([-1, -1, -1].map((sign) => sign * kWorld / 2), kWorld);
  const rows = [];
  for (const {name} of run.result.uavs) {
    const leaves = run.map(name);
    if (leaves === null) continue;
    const volume = (wanted) =>
        leaves.reduce((sum, [, edge, occupied]) => sum + (occupied === wanted ? edge ** 3 : 0), 0);
    const known = leaves.reduce((sum, [lowest, edge]) => sum + held(lowest, edge), 0);
    rows.push([volume(true), volume(false), whole > 0 ? (100 * known) / whole : null]);
  }
  return rows.length > 0 ? rows : null;
}

/**
 * @returns the share of the run in which each link was open; by UAV, the percentage with a direct and with a relayed
 * link.
 */
function contact({result, events}) {
  const names = result.uavs.map((uav) => uav.name);
  const up = new Set();
  const shares = new Map();
  const direct = new Map(names.map((name) => [name, 0]));
  const relayed = new Map(names.map((name) => [name, 0]));
  const end = Math.max(result.sim_time_s, Number(events.at(-1).time_s));
  const changes = events.filter((event) => event.event.startsWith('link_'));
  let since = 0;
  const pass = (until) => {
    const span = until - since;
    if (!(span > 0)) return;
    for (const link of up) shares.set(link, (shares.get(link) ?? 0) + span / end);
    const reached = new Set(['gcs']);
    for (let before = 0; before !== reached.size;) {
      before = reached.size;
      for (const link of up) {
        const [from, to] = link.split('>');
        if (reached.has(to)) reached.add(from);
      }
    }
    for (const name of names) {
      if (up.has(`${name}>gcs`))
        direct.set(name, direct.get(name) + (100 * span) / end);
      else if (reached.has(name))
        relayed.set(name, relayed.get(name) + (100 * span) / end);
    }
    since = until;
  };
  for (const change of changes) {
    pass(Number(change.time_s));
    const link = `${change.subject}>${change.object}`;
    if (change.event === 'link_up')
      up.add(link);
    else
      up.delete(link);
  }
  pass(end);
  return {shares, direct, relayed};
}

function uavs(run) {
  const {direct, relayed} = contact(run);
  return run.result.uavs.map(
      (uav) =>
          [run.result.score_by_uav[uav.name], uav.captures, uav.distance_m, uav.max_speed_mps, uav.idle_s,
           direct.get(uav.name), relayed.get(uav.name)]);
}

const kUses = [
  /^(on the ground|takes off)/, /^waits to be shown/, /^(flies to a (goal|set-point)|flies along|sends commands)/,
  /^(rests at its goal|holds its place|has no goal)/, /^shows /,
  /^(looks |flies nearer|tries |climbs to see more|flies back|makes room)/, /^stands: /,
  /^(returns|delivers|waits for a link|stays |flies to its landing)/, /^/
];

/** @returns by UAV, the seconds of each kind of activity while its program takes part. */
function timeUse({result, events, activity}) {
  if (!activity?.length) return null;
  const end = Math.max(result.sim_time_s, Number(events.at(-1).time_s));
  return result.uavs.map(({name}) => {
    const said = activity.filter((row) => row.uav === name);
    if (said.length === 0) return kUses.map(() => null);
    const sums = kUses.map(() => 0);
    // Changes of both kinds in order of time; those of a program first.
    const changes = [
      ...events.filter(({event, subject}) => subject === name && (event === 'joined' || event === 'left')),
      ...said.map((row) => ({...row, event: 'said'})), {time_s: end, event: 'end'}
    ].sort((a, b) => Number(a.time_s) - Number(b.time_s));
    let since = 0, joined = false, use = null;
    for (const change of changes) {
      if (joined && use !== null) sums[use] += Number(change.time_s) - since;
      since = Number(change.time_s);
      if (change.event === 'said')
        use = change.waits_for !== '' ? 1 : kUses.findIndex((words) => words.test(change.mode));
      else
        joined = change.event === 'joined';
    }
    return sums;
  });
}

/** @returns lost score and number of the points that no picture shows: of those far from all UAVs, and near one. */
function unseen({scene, losses: lost, trajectories}) {
  const points = (lost ?? []).filter((row) => row.cause === 'never_in_picture');
  if (points.length === 0 || !scene.cameras?.length) return null;
  const ranges = new Map(scene.cameras.map((camera) => [camera.uav, camera.range_m]));
  const places = trajectories.filter((row) => row.alive !== '0')
      .map((row) => [Number(row.x), Number(row.y), Number(row.z), ranges.get(row.uav) ?? -1]);
  const rows = [[0, 0], [0, 0]];
  for (const row of points) {
    const [x, y, z] = [Number(row.x), Number(row.y), Number(row.z)];
    const near = places.some(([a, b, c, range]) => Math.hypot(a - x, b - y, c - z) <= range);
    rows[near ? 1 : 0][0] += Number(row.loss);
    rows[near ? 1 : 0][1] += 1;
  }
  return rows;
}

/** @returns lost score and number of the points without a good enough picture, by the worst part of their best one. */
function poor({losses: lost}) {
  const points = (lost ?? []).filter((row) => row.cause === 'below_threshold');
  const rows = ['distance', 'tilt', 'blur', 'unsplit']
      .map((part) => points.filter((row) => (row.part ?? 'unsplit') === part))
      .filter((some) => some.length > 0)
      .map((some) => [some.reduce((sum, row) => sum + Number(row.loss), 0), some.length]);
  return rows.length > 0 ? rows : null;
}

function links(run) {
  const nodes = ['gcs', ...run.result.uavs.map((uav) => uav.name)];
  const {shares} = contact(run);
  return nodes.map((from) => nodes.flatMap((to) => {
    const link = run.result.radio.per_link.find((candidate) => candidate.from === from && candidate.to === to);
    const share = shares.get(`${from}>${to}`);
    if (from === to || (link === undefined && share === undefined)) return [];
    if (link === undefined) return [100 * share];
    return [100 * (share ?? 0), link.delivered, link.sent, link.delivered_bytes / 1000];
  }));
}

function latency({captures}) {
  if (captures.length === 0) return null;
  const whole = new Map();
  for (const row of captures) {
    const delay = row.delivered_at_s === '' ? null : Number(row.delivered_at_s) - Number(row.time_s);
    const key = `${row.uav} ${row.capture}`;
    whole.set(key, whole.get(key) ?? delay);
  }
  const delays = [...whole.values()].filter((delay) => delay !== null).sort((a, b) => a - b);
  const quantile = (share) => delays[Math.max(Math.ceil(share * delays.length), 1) - 1] ?? null;
  return [[quantile(0.5)], [quantile(0.9)], [delays.at(-1) ?? null], [whole.size - delays.length]];
}

function cores({result}) {
  const cpu = Object.values(result.processes).reduce((sum, use) => sum + use.cpu_s, 0);
  return cpu > 0 && result.wall_time_s > 0 ? cpu / result.wall_time_s : null;
}

function simulation({result: {timing}}) {
  const parts = ['physics', 'lidar', 'camera', 'links', 'recording'].map((part) => timing[`${part}_s`]);
  parts.push(timing.cpu_s - parts.reduce((sum, part) => sum + part, 0));
  return parts.map((part) => [part, 100 * part / timing.cpu_s]);
}

/** @returns rows of numbers by table, null for a dash; a table that is null must not be on the page. */
export function expectedTables(run) {
  const {result} = run;
  const {radio} = result;
  return {
    losses: losses(run),
    boxes: boxes(run),
    uavs: uavs(run),
    time: timeUse(run),
    unseen: unseen(run),
    poor: poor(run),
    links: links(run),
    latency: latency(run),
    maps: maps(run),
    radio: [
      [radio.sent], [radio.delivered], [radio.dropped_no_los], [radio.dropped_fault], [radio.dropped_overflow],
      [radio.delivered_bytes / 1000]
    ],
    planners: result.uavs.map(
        (uav) => [uav.planner_cpu_s, uav.planner_cpu_p99_ms, uav.planner_cpu_max_ms, uav.planner_exchanges_over_50ms]),
    simulation: simulation(run),
    machine: [
      [result.sim_time_s], [result.wall_time_s], [result.real_time_factor], [cores(run)], [result.startup_s],
      [result.memory_mb]
    ],
    processes: Object.values(result.processes).map((use) => [use.cpu_s, use.peak_memory_mb]),
    faults: result.faults.some((fault) => fault.began_step !== null) ?
        result.faults.filter((fault) => fault.began_step !== null)
            .map(
                (fault) =>
                    [fault.began_step * result.exchange_period_s,
                     fault.ended_step === null ? result.sim_time_s : fault.ended_step * result.exchange_period_s]) :
        null,
    collisions: result.collisions.length > 0 ? result.collisions.map((collision) => [collision.time_s]) : null,
  };
}

/** Columns of tables that contain words, not numbers. */
export const kWords = {
  processes: [0, 1],
  uavs: [0, 1, 2, 3],
  losses: [0, 4],
  collisions: [0, 1]
};

/** @returns the numbers in a cell's text as [value, decimals]; null for a dash. */
export function numbersOf(text) {
  if (text.trim() === '–') return [null];
  return [...text.matchAll(/-?\d+(?:\.(\d+))?/g)].map((match) => [number(match[0]), (match[1] ?? '').length]);
}
