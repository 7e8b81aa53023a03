// Limits of the past that the page stores, so that a flight of an hour takes as much memory as one of ten minutes: the
// newest part is complete, older parts are coarser. When a list reaches its greatest length, its older half is thinned
// to half as many entries, evenly over its time.

/** Poses of each UAV: one every half second; the first are thinned after 800 s. */
export const kMostPoses = 1600;
/** Steps of a curve: of the score, or of undelivered captures. */
export const kMostSteps = 4000;
/** States of all radio links. */
export const kMostLinks = 2400;
/** Activity reports of a UAV. */
export const kMostSayings = 600;
/** Numbers in a list of spans, two each. */
export const kMostSpans = 1000;
export const kMostEvents = 2000;

/**
 * Thins lists.
 * @param columns  of equal length; the first has times, ascending.
 * @returns whether it removed entries.
 */
export function thin(columns, most) {
  const [times] = columns;
  const {length} = times;
  if (length < most) return false;
  const half = length >> 1;
  const least = (times[half] - times[0]) / (half >> 1);  // time between two entries that stay
  let [kept, due] = [0, -Infinity];
  for (let i = 0; i < length; ++i) {
    const time = times[i];
    if (i < half && time < due) continue;
    due = time + least;
    for (const column of columns) column[kept] = column[i];
    ++kept;
  }
  for (const column of columns) column.length = kept;
  return true;
}

/** Removes the shortest spans, and the shortest gaps. @param spans  flat list: begin and end of each span [s]. */
export function thinSpans(spans, most = kMostSpans) {
  if (spans.length < most) return;
  for (let least = 0.5; spans.length > most / 2; least *= 2) {
    let kept = 0;
    for (let i = 0; i < spans.length; i += 2) {
      if (kept > 0 && spans[i] - spans[kept - 1] < least)
        spans[kept - 1] = spans[i + 1];
      else if (spans[i + 1] - spans[i] >= least) {
        spans[kept++] = spans[i];
        spans[kept++] = spans[i + 1];
      }
    }
    spans.length = kept;
  }
}

/**
 * Thins the older half of the events: removes the many deliveries, then, if that does not suffice, every second event.
 */
export function thinEvents(events, most = kMostEvents) {
  if (events.length < most) return;
  const half = events.length >> 1;
  const stay = events.filter(({event}, i) => i >= half || event !== 'delivered');
  const crowded = stay.length > 0.75 * most;
  events.splice(0, events.length, ...stay.filter((_, i) => !crowded || i >= stay.length >> 1 || i % 2 === 0));
}
