// The WebSocket of the page: receives the flight and sends the browser's orders. When the connection is lost, as at the
// end of a run, when another server begins to serve its replay, the page connects again until a server answers.

const kAgain = 400;  // ms between two attempts

/** @param use  callbacks {scene, lines, state, clouds, gone}. @returns a function that sends an order. */
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
