// The WebSocket of the page: what the flight tells, and what is asked of it. When whoever serves it goes, as it
// does when the run is over and its replay begins, it asks again until somebody answers.

const kAgain = 400;  // ms

/** @param use  {scene, lines, state, clouds, gone}: what to do with each. @returns how to send an order. */
export function connect(use) {
  let socket = null;
  const open = () => {
    socket = new WebSocket(`ws://${location.host}/flight`);
    socket.addEventListener('message', ({data}) => {
      const message = JSON.parse(data);
      if (message.scene) use.scene(message.scene);
      if (message.lines) use.lines(message.lines, message.more === true);
      if (message.state) use.state(message.state);
      if (message.clouds) use.clouds(message.clouds);
    });
    socket.addEventListener('close', () => {
      socket = null;
      use.gone();
      setTimeout(open, kAgain);
    });
  };
  open();
  return (order) => socket?.readyState === WebSocket.OPEN && socket.send(JSON.stringify(order));
}
