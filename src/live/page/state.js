// What the page knows of the session: the last hello, the newest frame, the events so far.
// Messages in → listeners told by kind: "hello", "frame", "props", "events", "told", "files",
// "saved", "connected" (with true or false), "texts" (at most 12 times a second, after a frame) and
// "character" (another one was chosen). With "events" comes the place from which they are new.

const TEXTS_EVERY = 80;

export function makeState() {
  const listeners = new Map();
  const state = {
    hello: null,
    frame: null,
    events: [],
    props: [],
    connected: false,
    /** Place of the character that panels and keys are about. */
    character: 0,
    send: () => false,
    on(kind, act) {
      if (!listeners.has(kind)) listeners.set(kind, []);
      listeners.get(kind).push(act);
    },
    heard,
    connection(connected) {
      state.connected = connected;
      tell("connected", connected);
    },
    choose(character) {
      if (!state.hello || !state.hello.characters[character] || character === state.character) return;
      state.character = character;
      tell("character", character);
      texts();
    },
    /** The chosen character: of hello, and of the newest frame. */
    body: () => state.hello?.characters[state.character] ?? null,
    now: () => state.frame?.c[state.character] ?? null,
  };

  function tell(kind, value, more) {
    for (const act of listeners.get(kind) ?? []) act(value, more);
  }

  let textsAt = 0;
  let textsTimer = null;
  function texts() {
    clearTimeout(textsTimer);
    textsTimer = null;
    textsAt = performance.now();
    if (state.hello && state.frame) tell("texts", state.frame);
  }

  /** A frame of an earlier hello may still be on its way; it would not fit. */
  function fits(frame) {
    const characters = state.hello?.characters;
    return (
      characters !== undefined &&
      frame.c.length === characters.length &&
      frame.c.every(
        (one, k) =>
          one.l.length === 3 * characters[k].links.length &&
          one.bids.length === characters[k].controllers.length,
      )
    );
  }

  const kinds = {
    hello(message) {
      state.hello = message;
      state.props = message.props;
      state.frame = null;
      state.events = [];
      state.character = Math.min(state.character, message.characters.length - 1);
      tell("hello", message);
      tell("events", state.events, 0);
    },
    frame(message) {
      if (!fits(message)) return;
      state.frame = message;
      tell("frame", message);
      if (textsTimer !== null) return;
      textsTimer = setTimeout(texts, Math.max(0, textsAt + TEXTS_EVERY - performance.now()));
    },
    props(message) {
      state.props = state.props.slice(0, message.from).concat(message.list);
      tell("props", state.props);
    },
    events(message) {
      state.events = state.events.slice(0, message.from).concat(message.list);
      tell("events", state.events, message.from);
    },
    told: (message) => tell("told", message),
    files: (message) => tell("files", message),
    saved: (message) => tell("saved", message),
  };

  function heard(message) {
    if (Object.hasOwn(kinds, message.is)) kinds[message.is](message);
  }

  return state;
}
