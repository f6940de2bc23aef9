// The session behind the page when there is no server: WebAssembly, in a worker, 60 times a second.
// Strings of the live protocol in and out. Beside those of the protocol it answers
//   {"do":"save","name":…} → {is:"saved",name,bytes}, or {is:"saved",name,error}
//   {"do":"digest"}        → {"is":"digest","text":…}, for tests
// and the page says `null` for each message that it has taken: while it is busy, frames are left out.

const BETWEEN = 1000 / 60; // ms
const MOST_UNTAKEN = 4; // messages on their way to the page beyond which frames are left out
const MOST_BREAKDOWNS = 3; // until it is given up

const waiting = []; // what the page says before the session has begun
let module = null;
let session = null; // what the module exports
let breakdowns = 0;
let untaken = 0;
let dropped = 0;
let timer = null;
let last = 0;
let next = 0;

onmessage = (event) => {
  if (event.data === null) untaken = Math.max(0, untaken - 1);
  else if (session) guarded(() => hear(event.data));
  else waiting.push(event.data);
};

function post(message) {
  untaken += 1;
  postMessage(message);
}

function tell(ok, text) {
  post(JSON.stringify({ is: "told", ok, text }));
}

/** Lays a text out for the session; returns its length in bytes. */
function write(text) {
  const bytes = new TextEncoder().encode(text);
  const place = session.room(bytes.length) >>> 0;
  new Uint8Array(session.memory.buffer, place, bytes.length).set(bytes);
  return bytes.length;
}

/** A copy of so many bytes that the session has laid out. */
function read(length) {
  const place = session.out() >>> 0;
  return new Uint8Array(session.memory.buffer, place, length).slice();
}

function text(length) {
  return new TextDecoder().decode(read(length >>> 0));
}

function hear(said) {
  let message = null;
  try {
    message = JSON.parse(said);
  } catch {
    // The session says what is wrong with it.
  }
  if (message?.do === "save") save(String(message.name));
  else if (message?.do === "digest") post(JSON.stringify({ is: "digest", text: text(session.digest()) }));
  else session.ask(write(said));
}

function save(name) {
  const length = session.save(write(name));
  if (length < 0) {
    post({ is: "saved", name, error: text(-length) });
    return;
  }
  const bytes = read(length).buffer;
  untaken += 1;
  postMessage({ is: "saved", name, bytes }, [bytes]);
}

function tellNews() {
  for (let length = session.next_message(); length > 0; length = session.next_message())
    post(text(length));
}

function round() {
  const now = performance.now();
  guarded(() => {
    session.advance((now - last) / 1000);
    last = now;
    tellNews();
    if (untaken > MOST_UNTAKEN) dropped += 1;
    else post(text(session.frame(dropped)));
  });
  next = Math.max(next + BETWEEN, performance.now());
  if (session) timer = setTimeout(round, next - performance.now());
}

/** Does something with the session. A panic in it is told, and another session begins. */
function guarded(act) {
  try {
    act();
  } catch (error) {
    let why = "";
    try {
      why = text(session.last_words());
    } catch {
      // It is past speaking.
    }
    console.error(error, why);
    session = null;
    clearTimeout(timer);
    breakdowns += 1;
    const after =
      breakdowns < MOST_BREAKDOWNS ? "The session begins anew." : "Load the page again to begin anew.";
    tell(false, `The session broke down, which is a defect of the program: ${why || error}. ${after}`);
    if (breakdowns < MOST_BREAKDOWNS) begin();
  }
}

async function begin() {
  let begun;
  try {
    begun = (await WebAssembly.instantiate(module, {})).exports;
  } catch (error) {
    tell(false, `The session cannot begin: ${error}`);
    return;
  }
  session = begun;
  guarded(() => {
    const refusal = session.begin();
    if (refusal > 0) throw new Error(text(refusal));
    while (waiting.length > 0) hear(waiting.shift());
    last = next = performance.now();
    timer = setTimeout(round, 0);
  });
}

async function load() {
  const address = new URL("aplomb.wasm", import.meta.url);
  try {
    const answer = await fetch(address);
    if (!answer.ok) throw new Error(`${address.pathname}: the server says ${answer.status}`);
    module = await WebAssembly.compile(await answer.arrayBuffer());
  } catch (error) {
    tell(false, `The session cannot be loaded: ${error.message}`);
    return;
  }
  await begin();
}

load();
