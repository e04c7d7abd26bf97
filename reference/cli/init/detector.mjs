// A beginning that is wrong: it says that two bodies touch where their boxes do. To answer with pairs
// of triangles, declare levels ["body", "triangle"] and questions ["triangles", "body"]. A query then
// has line.question; the answer to "triangles" is {message: "contacts", triangles: N}, followed by N
// times four numbers: body a, body b (a below b), triangle of a, triangle of b.
import {readSync, writeSync} from "node:fs";

// What a library prints would be read as an answer: it goes to standard error.
Object.defineProperty(process, "stdout", {get: () => process.stderr});

let buffer = Buffer.alloc(0);              // bytes that were read and not used yet
const chunk = Buffer.alloc(1 << 16);

function more() {
  const count = readSync(0, chunk);
  buffer = Buffer.concat([buffer, chunk.subarray(0, count)]);
  return count > 0;
}

function readLine() {                      // null at the end of the input
  for (;;) {
    const end = buffer.indexOf(10);
    if (end >= 0) {
      const line = buffer.toString("utf8", 0, end);
      buffer = buffer.subarray(end + 1);
      return JSON.parse(line);
    }
    if (!more()) return null;
  }
}

function readBytes(count) {
  const bytes = new Uint8Array(count);
  let have = Math.min(count, buffer.length);
  bytes.set(buffer.subarray(0, have));
  buffer = buffer.subarray(have);
  while (have < count) {
    const read = readSync(0, bytes, have, count - have);
    if (read === 0) throw new Error("the input ends within a message");
    have += read;
  }
  return bytes.buffer;
}

let data, at;                              // the numbers after the line, and the next one's place

// The next numbers, Float64Array or Uint32Array: a copy, for doubles may begin at any byte.
function take(Type, count) {
  const begin = at;
  at += Type.BYTES_PER_ELEMENT * count;
  return new Type(data.slice(begin, at));
}

function write(line, numbers = []) {
  const bytes = Buffer.from(Uint32Array.from(numbers).buffer);
  const all = Buffer.concat([Buffer.from(JSON.stringify({...line, bytes: bytes.length}) + "\n"), bytes]);
  for (let done = 0; done < all.length;) done += writeSync(1, all, done);
}

function box(x) {                          // lowest and highest x, y and z
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < x.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], x[i]);
    high[i % 3] = Math.max(high[i % 3], x[i]);
  }
  return {low, high};
}

const overlap = (a, b) => a.low.every((low, k) => low <= b.high[k] && b.low[k] <= a.high[k]);

let bodies, now;
for (let line = readLine(); line !== null; line = readLine()) {
  data = readBytes(line.bytes ?? 0);
  at = 0;
  if (line.message === "hello") {
    write({message: "hello", protocol: "contactcheck-pipe/1", id: "mine", needs: ["vertices"],
           prepares_again: true, warm_up: 200,  // frames that are not timed, while V8 compiles
           semantics: {levels: ["body"], questions: ["body"]}});
  } else if (line.message === "prepare") {
    bodies = line.bodies.map(({vertices, triangles, lattice}) => {
      const body = {vertices, rest: take(Float64Array, 3 * vertices), triangles: take(Uint32Array, 3 * triangles)};
      if (lattice) {
        body.nodes = take(Float64Array, 3 * lattice.nodes);
        body.corners = take(Uint32Array, 8 * lattice.cells);
        body.homeCells = take(Uint32Array, vertices);
        body.coordinates = take(Float64Array, 3 * vertices);
        body.starts = take(Uint32Array, triangles + 1);
        body.cellsOfTriangles = take(Uint32Array, lattice.labels);
      }
      return body;
    });
    write({message: "ready"});
  } else if (line.message === "frame") {
    now = bodies.map((body) => box(take(Float64Array, 3 * body.vertices)));
    write({message: "done"});
  } else {                                 // query
    const found = [];
    for (let b = 0; b < now.length; ++b)
      for (let a = 0; a < b; ++a)
        if (overlap(now[a], now[b])) found.push(a, b);
    write({message: "contacts", bodies: found.length / 2}, found);
  }
}
