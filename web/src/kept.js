// A flight that the page itself holds (skein replay --export): nothing is fetched. It is told as a server tells it.

/** Base64 of a zlib stream of UTF-8. */
export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).text();
}

/** @param holder  the element with the flight. @param use  as connect() has it. @returns takes orders, and follows none. */
export function tellKept(holder, use) {
  const text = holder.textContent;
  holder.remove();
  unpacked(text).then((json) => {
    const {scene, lines} = JSON.parse(json);
    delete scene.clouds;  // points and maps are sent on demand, and here nobody sends them
    use.scene(scene);
    use.lines(lines, false);
  });
  return () => {};
}
