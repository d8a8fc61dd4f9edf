// What is packed into the page, in base64: data in gzip, the library in xz, which is half as large.
import { XzReadableStream } from "xz-decompress";

function packed(id) {
  const text = document.getElementById(id).textContent.trim();
  return new Blob([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))]).stream();
}

export const embeddedJson = async (id) => new Response(packed(id).pipeThrough(new DecompressionStream("gzip"))).json();

export async function embeddedLibrary(id) {
  return new Uint8Array(await new Response(new XzReadableStream(packed(id))).arrayBuffer());
}
