// Wires the page: the connection feeds the state, the state tells the parts, the parts send messages.

import { connect } from "./connection.js";
import { makeState } from "./state.js";
import { makeCamera } from "./camera.js";
import { makeStage } from "./stage.js";
import { makePointer } from "./pointer.js";
import { makeGestures } from "./gestures.js";
import { makeLegend, toggles } from "./legend.js";
import { makeTheme } from "./theme.js";
import { makeDrive } from "./drive.js";
import { makeTabs } from "./tabs.js";
import { makeTold } from "./told.js";
import { makeCommands } from "./commands.js";
import { makeContract } from "./contract.js";
import { makeMind } from "./mind.js";
import { makeTimeline } from "./timeline.js";
import { makeWhy } from "./why.js";
import { makePlots } from "./plots.js";
import { makeScene } from "./scene.js";
import { makeSave } from "./save.js";
import { makeLink } from "./link.js";
import { makeKeys } from "./keys.js";

const TOOLS = ["drag", "push", "ball", "crate", "pan"];

const state = makeState();
const on = toggles();
const camera = makeCamera();
const stage = makeStage(state, camera, on);
const pointer = makePointer(state, stage, camera);
const gestures = makeGestures(stage, camera, pointer);
const legend = makeLegend(on, stage);
const tabs = makeTabs();
const told = makeTold(state);
const drive = makeDrive(state);
const commands = makeCommands(state);
const contract = makeContract(state, commands);
const mind = makeMind(state, contract);
const timeline = makeTimeline(state);
const why = makeWhy(state, drive, tabs, contract);
const plots = makePlots(state, tabs);
const scene = makeScene(state, told);
let connection = null;
const save = makeSave(state, stage, timeline, () => connection, told);
makeLink(state, save, scene, told);
tabs.on("why", why.refresh);

const theme = makeTheme(() => {
  stage.touch();
  timeline.draw();
  legend.paint();
  mind.paint();
  why.refresh();
  plots.restyle();
});

makeKeys(state, {
  toggle: drive.toggle,
  step: () => drive.step(),
  back: () => drive.back(),
  backSecond: drive.backSecond,
  onSecond: drive.onSecond,
  slower: () => drive.faster(-1),
  faster: () => drive.faster(1),
  reset: drive.reset,
  branch: drive.branch,
  explain: why.explain,
  before: why.before,
  after: why.after,
  follow: gestures.follow,
  legend: () => legend.open(),
  theme: theme.toggle,
  tool: (place) => pointer.choose(TOOLS[place]),
  escape() {
    pointer.cancel();
    legend.close();
    told.clear();
  },
  note: told.note,
  forget: told.forget,
});

connection = connect(state.heard, state.connection);
state.send = (message) => connection.send(message);

/** For tests: what the page knows, and where things are, in client pixels. */
window.aplomb = {
  state,
  get frame() {
    return state.frame;
  },
  get hello() {
    return state.hello;
  },
  get events() {
    return state.events;
  },
  toScreen(x, y) {
    const box = stage.canvas.getBoundingClientRect();
    const [px, py] = camera.toScreen(x, y);
    return [px + box.left, py + box.top];
  },
  toWorld(px, py) {
    const box = stage.canvas.getBoundingClientRect();
    return camera.toWorld(px - box.left, py - box.top);
  },
  timelineX: timeline.toX,
};
