// Prepares a curve of steps for drawing. Pure.

/**
 * Steps narrower than a pixel are merged into one bar with their greatest value; a wider step is one bar.
 * @param t, v  begin and value of each step. @param end  of the last step. @param place  function from a time to
 * pixels.
 * @returns [from, to, value] of each bar, in pixels, in order.
 */
export function barsOf({t, v}, end, place) {
  const bars = [];
  for (let i = 0; i < t.length;) {
    const first = i;
    const from = place(t[i]);
    let [to, most] = [from, 0];
    do {
      const next = place(i + 1 < t.length ? t[i + 1] : end);
      if (i > first && next - place(t[i]) >= 1) break;
      most = Math.max(most, v[i++]);
      to = next;
    } while (i < t.length && to - from < 1);
    bars.push([from, to, most]);
  }
  return bars;
}
