// A link that holds a whole session: its scenario as text, deflated, as base64url after `#s=`.
// Whoever opens it runs the same; nothing is stored anywhere.

import { byId, show } from "./dom.js";
import { MOST_TEXT } from "./scene.js";

export function makeLink(state, save, scene, told) {
  byId("save-link").addEventListener("click", async () => {
    try {
      const text = new TextDecoder().decode(await save.bytes("session.ron"));
      const address = `${location.href.split("#")[0]}#s=${await pack(text)}`;
      const field = byId("link-text");
      field.value = address;
      show(field, true);
      field.select();
      const copied = await copy(address);
      told.note(true, copied ? "The link is in the clipboard." : "Copy the link from the field.");
    } catch (error) {
      told.note(false, `No link: ${error.message}`);
    }
  });

  async function copy(text) {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch {
      return false;
    }
  }

  // Once after loading, and when somebody puts another link into the address.
  let opened = "";
  async function follow() {
    const found = location.hash.match(/^#s=([\w-]+)$/);
    if (!found || found[1] === opened || !state.hello) return;
    opened = found[1];
    try {
      scene.open("link.ron", await unpack(found[1]));
    } catch {
      told.note(false, "The link is damaged: it holds no scenario.");
    }
  }
  state.on("hello", follow);
  addEventListener("hashchange", follow);
}

async function through(bytes, stream, most) {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) throw new Error("it is too long");
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

export async function pack(text) {
  const bytes = await through(
    new TextEncoder().encode(text),
    new CompressionStream("deflate-raw"),
    MOST_TEXT,
  );
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export async function unpack(letters) {
  const bytes = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (one) =>
    one.charCodeAt(0),
  );
  return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw"), MOST_TEXT));
}
