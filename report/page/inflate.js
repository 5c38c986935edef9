/* Inverse of packed() of report/page_arrays.cpp. */

async function inflate(base64) {
  if (typeof DecompressionStream === "undefined")
    throw new Error(
      "This browser cannot unpack the numbers of this page (it lacks " +
        "DecompressionStream). Open the file with Chrome 103, Firefox 113, Safari 16.4 or newer.",
    );
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
