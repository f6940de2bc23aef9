// The way to the session: messages out as objects, messages in as objects. Over a WebSocket to the
// server that sent the page, or to a worker in the page, chosen by `<html data-worker="worker.js">`.
// A lost connection is sought again, at first at once, later every five seconds.

const FIRST_WAIT = 400;
const LONGEST_WAIT = 5000;

/** `heard(message)` for each message, `state(true | false)` when connected or not. Gives `send`. */
export function connect(heard, state) {
  const worker = document.documentElement.dataset.worker;
  return worker ? byWorker(worker, heard, state) : bySocket(heard, state);
}

function read(data, heard) {
  let message = data;
  if (typeof data === "string") {
    try {
      message = JSON.parse(data);
    } catch {
      return;
    }
  }
  if (message && typeof message.is === "string") heard(message);
}

function bySocket(heard, state) {
  const address = new URL("live", location.href);
  address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  address.hash = "";
  address.search = "";
  let socket = null;
  let wait = FIRST_WAIT;
  let timer = null;

  function open() {
    clearTimeout(timer);
    timer = null;
    const mine = new WebSocket(address);
    socket = mine;
    mine.onopen = () => {
      wait = FIRST_WAIT;
      state(true);
    };
    mine.onmessage = (event) => {
      if (socket === mine) read(event.data, heard);
    };
    mine.onclose = () => {
      if (socket !== mine) return;
      state(false);
      timer = setTimeout(open, wait);
      wait = Math.min(wait * 1.7, LONGEST_WAIT);
    };
  }

  // Somebody who looks at the page again, or whose network is back, need not wait.
  function soon() {
    if (timer !== null && document.visibilityState === "visible") open();
  }
  addEventListener("online", soon);
  document.addEventListener("visibilitychange", soon);
  open();

  return {
    worker: false,
    send(message) {
      const ready = socket.readyState === WebSocket.OPEN;
      if (ready) socket.send(JSON.stringify(message));
      return ready;
    },
  };
}

function byWorker(address, heard, state) {
  const worker = new Worker(new URL(address, document.baseURI), { type: "module" });
  let ready = false;
  worker.onmessage = (event) => {
    if (!ready) {
      ready = true;
      state(true);
    }
    worker.postMessage(null); // taken: it may send the next frame
    read(event.data, heard);
  };
  worker.onerror = () => {
    ready = false;
    state(false);
  };
  return {
    worker: true,
    send(message) {
      worker.postMessage(JSON.stringify(message));
      return true;
    },
  };
}
