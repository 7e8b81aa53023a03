// A flight that the page itself holds (skein replay --export): nothing is fetched. It is told as a server tells it.

/** Base64 of a zlib stream of UTF-8. */
export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).text();
}

/** @param kept  {lidar, maps}: which of them the page holds (view/kept_flight.hpp); none: they are not spoken of. */
function tellWhatIsKept(scene, kept) {
  if (!kept) delete scene.clouds;
  if (!scene.clouds) return;
  const names = {lidar: 'LiDAR points', maps: 'Maps'};
  for (const kind of Object.keys(names)) {
    if (kept[kind] || scene.clouds[kind].length === 0) continue;
    scene.clouds[kind] = [];
    scene.clouds.missing = `${scene.clouds.missing} ${names[kind]} would make this file too large: skein replay shows them.`.trim();
  }
}

/** @param holder  the element with the flight. @param use  as connect() has it. @returns takes orders. */
export function tellKept(holder, use) {
  const text = holder.textContent;
  const clouds = new Map();  // of those that nobody has asked for yet, by name
  holder.remove();
  unpacked(text).then((json) => {
    const told = JSON.parse(json);
    for (const cloud of told.clouds ?? []) clouds.set(cloud.n, cloud);
    tellWhatIsKept(told.scene, told.kept);
    use.scene(told.scene);
    use.lines(told.lines, false);
  });
  return (order) => {
    if (order.do !== 'look') return;
    const asked = [...(order.lidar ?? []).map((uav) => `lidar ${uav}`), `map ${order.map}`].filter((name) => clouds.has(name));
    const found = asked.map((name) => clouds.get(name));
    for (const name of asked) clouds.delete(name);
    if (found.length > 0) use.clouds(found);
  };
}
