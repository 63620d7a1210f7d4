// SPDX-License-Identifier: GPL-3.0-or-later
// Unpacks the parts of the page, which are gzip data with seven bits per character; see make_page.py.

(async () => {
  const forbidden = [0, 13, 60];
  const unpack = id => {
    const {textContent: text, dataset: {length}} = document.getElementById(id), bytes = new Uint8Array(Number(length) + 2);
    let size = 0, buffer = 0, bits = 0;
    const put = seven => {
      buffer = (buffer << 7 | seven) & 0x7fff;
      bits += 7;
      if (bits < 8) return;
      bits -= 8;
      bytes[size++] = buffer >> bits;
    };
    for (let i = 0; i < text.length; ++i) {
      const code = text.charCodeAt(i);
      if (code >= 128) put(forbidden[(code - 256) >> 7]);
      put(code & 127);
    }
    const stream = new Blob([bytes.subarray(0, length)]).stream();
    return new Response(stream.pipeThrough(new DecompressionStream('gzip')));
  };
  try {
    const [wasm, worker, script] = await Promise.all([unpack('wasm').arrayBuffer(), unpack('worker').text(),
                                                      unpack('script').text()]);
    new Function('wasmBytes', 'workerText', script)(wasm, worker);
  } catch (error) {
    document.getElementById('message').textContent =
        'This page could not start; use a browser of 2023 or later.\n' + error.message;
  }
})();
