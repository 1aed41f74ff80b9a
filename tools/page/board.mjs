// A board on a serial line. The line is two streams of bytes, as WebSerial
// gives them; frames are decoded by the C core. A board waits to be asked for
// its schema, without which its numbers have no type.

import { AT, COLUMNS, firstOf } from './core.mjs';
import { instantiate } from './libc.mjs';

const AT_ONCE = 4096; // bytes, the rows of which the decoder has room for
const MAX_RECORDS = 1 << 14;
const ASK_EVERY = 1000; // [ms] until the schema has come

export class Line {
  // module: the compiled core. take(row): of each row, the columns of CSV;
  // those that the board did not send are 0.
  constructor(module, take) {
    this.c = instantiate(module);
    this.c.line_open();
    this.take = take;
    this.heard = '';
  }

  // Of frames, damaged, lost, rows, incomplete, unknown, schema, float, changes
  // of the run.
  get counters() {
    return Array.from(new Float64Array(this.c.memory.buffer,
      this.c.line_counters(), 9));
  }

  receive(bytes) {
    for (let at = 0; at < bytes.length; at += AT_ONCE) {
      const part = bytes.subarray(at, at + AT_ONCE);
      new Uint8Array(this.c.memory.buffer, this.c.text_bytes(), AT_ONCE)
        .set(part);
      const count = this.c.line_take(part.length);
      const columns = AT.set + 1;
      const rows = new Float64Array(this.c.memory.buffer, this.c.line_rows(),
        count * columns);
      for (let i = 0; i < count; i++)
        this.take(rows.slice(i * columns, (i + 1) * columns));
      // What a board says that breaks is no frame.
      this.heard = this.heard.slice(-200) + String.fromCharCode(...part);
      const fault = /\r\n(fault: [ -~]+)\r\n/.exec(this.heard);
      if (fault) throw new Error(fault[1]);
    }
  }

  describe() {
    const count = this.c.line_describe();
    return new Uint8Array(this.c.memory.buffer, this.c.text_bytes(), count)
      .slice();
  }

  // Reads until the line ends or close is called.
  async read({ readable, writable }) {
    const writer = writable?.getWriter();
    const ask = () => {
      if (!this.counters[6]) writer?.write(this.describe()).catch(() => {});
    };
    const timer = setInterval(ask, ASK_EVERY);
    this.reader = readable.getReader();
    ask();
    try {
      for (;;) {
        const { value, done } = await this.reader.read();
        if (done) break;
        this.receive(value);
      }
    } finally {
      clearInterval(timer);
      this.reader.releaseLock();
      writer?.releaseLock();
    }
  }

  close() { return this.reader?.cancel(); }
}

// What a board has sent, for the views of a motion: its clock counts seconds.
export class Record {
  // core: for the tables, and for the regions of the page's own set-up.
  constructor(core) {
    this.core = core;
    this.rows = new Float64Array(MAX_RECORDS * COLUMNS);
    this.now = new Float64Array(COLUMNS);
    this.now.set(core.row);
    this.now[AT.energy] = NaN; // a board does not tell it
    this.count = 0;
    this.changes = [];
    this.dt = 1;
  }

  get tick() { return this.now[AT.t]; }
  get last() { return this.now[AT.t]; }

  row(i) { return this.rows.subarray(i * COLUMNS, (i + 1) * COLUMNS); }
  value(i, column) { return this.rows[i * COLUMNS + column]; }

  indexAt(t) {
    return Math.max(0, firstOf(this.count, (i) => this.row(i)[AT.t] > t) - 1);
  }

  openings() {
    return this.changes.filter((change) => change[4] > 1)
      .map(([tick]) => tick);
  }

  take(values) {
    const { now } = this, before = this.count ? now[AT.mode] : values[AT.mode];
    now.set(values);
    const seconds = this.count ? now[AT.t] - this.row(this.count - 1)[AT.t] : 0;
    now[AT.phi] += now[AT.omega] * seconds;
    now[AT.table] += now[AT.omega0] * seconds;
    if (this.count && now[AT.t] < this.row(this.count - 1)[AT.t]) {
      this.count = 0; // it was started again
      this.changes = [];
    }
    if (this.count === MAX_RECORDS) {
      this.rows.copyWithin(0, MAX_RECORDS / 2 * COLUMNS);
      this.count /= 2;
    }
    this.rows.set(now, this.count++ * COLUMNS);
    if (this.count === 1 || before !== now[AT.mode])
      this.changes.push([now[AT.t], before, now[AT.mode], now[AT.set],
        now[AT.choices]]);
  }
}

// Lets the user pick a port. use(port): works with it until the line ends.
export async function openSerial(use) {
  if (!navigator.serial)
    throw new Error('This browser lacks WebSerial; Chromium has it.');
  const port = await navigator.serial.requestPort();
  await port.open({ baudRate: 115200 });
  try {
    await use(port);
  } finally {
    await port.close();
  }
}
