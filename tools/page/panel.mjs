// The set-up as sliders, fields and lists, all of them from the core's tables.
// A slider spans a neighbourhood of the scene's value, within the range of the
// core; the field beside it takes the whole range. What the core refuses stays
// in the field, with the reason, and the motion goes on as it was.
import { decimal } from './decimal.mjs';

const STEPS = 400;
const STARTS = [
  { name: 'r', unit: 'm', low: -1e9, high: 1e9, spread: 0.2 },
  { name: 'omega', unit: 'rad/s', low: -1e9, high: 1e9, spread: 1 },
  { name: 'h', unit: 'm/s', low: -1e9, high: 1e9, spread: 0.5 },
  { name: 'v', unit: 'm/s', low: -1e9, high: 1e9, spread: 0.5 },
];
const LOCATED = ['tolerance', 'segments']; // of that scheme, not the page's

// Position 0 to STEPS and back, over what the slider spans.
export function spanOf({ low, high, spread }, base) {
  if (high - low <= 10)
    return { to: (p) => low + (high - low) * p / STEPS,
      from: (x) => (x - low) / (high - low) * STEPS };
  if (low >= 0 && base > 0 && spread === undefined) {
    const a = Math.max(low, base / 10) || base / 10;
    const b = Math.min(high, base * 10);
    return { to: (p) => a * (b / a) ** (p / STEPS),
      from: (x) => Math.log(Math.max(x, a) / a) / Math.log(b / a) * STEPS };
  }
  const half = spread ?? Math.max(1, Math.abs(base));
  const a = Math.max(low, base - half), b = Math.min(high, base + half);
  return { to: (p) => a + (b - a) * p / STEPS,
    from: (x) => (x - a) / (b - a) * STEPS };
}

// Three digits more than the slider's step resolves.
const rounded = (x) => Number(x.toPrecision(6));
// What a field shows until it is entered.
const brief = (x) => decimal(rounded(x));

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

export class Panel {
  // change(name, value): informs the page. Returns: null or a refusal.
  constructor(core, change) {
    this.core = core;
    this.change = change;
    this.lists = document.getElementById('lists');
    this.numbers = document.getElementById('numbers');
    this.starts = document.getElementById('starts');
    this.refusal = document.getElementById('refusal');
    this.rows = {};
  }

  // The set-up in the core, of a scene whose own values are given: what its law
  // and rule use.
  show(own) {
    const { core } = this;
    this.own = own;
    this.rows = {};
    this.lists.replaceChildren();
    for (const [name, words] of Object.entries(core.lists)) {
      const select = element('select', { id: `list-${name}`, onchange: () =>
        this.#tell(name, select.selectedIndex, select) },
      ...words.map((word) => element('option', {}, word)));
      select.selectedIndex = core.get(name);
      const title = element('span', {}, name);
      this.rows[name] = { title, field: select };
      this.lists.append(element('label', {}, title, select));
    }
    const isRandom = core.lists.rule[core.get('rule')] === 'random';
    if (isRandom) this.#number({ name: 'seed', unit: '', low: 0,
      high: 4294967295 }, this.lists, true);
    this.numbers.replaceChildren();
    this.starts.replaceChildren();
    const law = core.get('law');
    for (const parameter of core.parameters)
      if (parameter.laws >> law & 1 && !LOCATED.includes(parameter.name) &&
        (isRandom || parameter.name !== 'rate'))
        this.#number(parameter, this.numbers);
    for (const start of STARTS)
      if (start.name !== (core.get('v is given') ? 'h' : 'v'))
        this.#number(start, this.starts);
    this.mark();
  }

  #number(about, place, isPlain = false) {
    const { name, low, high } = about;
    const value = this.core.get(name);
    const unit = about.unit === '1' ? '' : about.unit;
    const range = `${name}: ${low} to ${high} ${unit}`;
    const title = element('span', { title: range }, name);
    const field = element('input', { type: 'text', inputMode: 'decimal',
      value: brief(value), title: range, autocomplete: 'off',
      onfocus: () => { field.value = decimal(this.core.get(name)); },
      onblur: () => {
        if (field.getAttribute('aria-invalid') !== 'true')
          field.value = brief(this.core.get(name));
      },
      onchange: () => this.#tell(name, Number(field.value.trim() || NaN),
        field) });
    field.setAttribute('aria-label', range);
    if (isPlain) {
      this.rows[name] = { title, field };
      place.append(title, field);
      return;
    }
    const span = spanOf(about, this.own[name]);
    const slider = element('input', { type: 'range', min: 0, max: STEPS,
      step: 1, title: range, oninput: () => {
        const next = rounded(span.to(Number(slider.value)));
        field.value = brief(next);
        this.#tell(name, next, field);
      } });
    slider.setAttribute('aria-label', range);
    slider.value = span.from(value);
    this.rows[name] = { title, field, slider, span };
    place.append(title, slider, field, element('span', { className: 'unit' },
      unit));
  }

  #tell(name, value, field) {
    const refusal = this.change(name, value);
    this.refusal.hidden = !refusal;
    this.refusal.textContent = refusal ? refusal.text : '';
    field.setAttribute('aria-invalid', Boolean(refusal));
    if (refusal) return;
    for (const row of Object.values(this.rows))
      row.field.setAttribute('aria-invalid', false);
    const row = this.rows[name];
    if (row.slider) row.slider.value = row.span.from(value);
    if (name === 'law' || name === 'rule') this.show(this.own);
    else this.mark();
  }

  say(refusal) {
    this.refusal.hidden = !refusal;
    this.refusal.textContent = refusal ?? '';
  }

  // What differs from the scene.
  mark() {
    let count = 0;
    for (const [name, row] of Object.entries(this.rows)) {
      const differs = !Object.is(this.core.get(name), this.own[name]);
      row.title.className = differs ? 'was' : '';
      count += differs;
    }
    document.getElementById('changed').textContent =
      count ? `${count} changed` : 'as in the scene';
  }
}

// Two sliders that push while they are not at their middle.
export class Hand {
  constructor(push) {
    this.push = push;
    this.values = { force: 0, torque: 0 };
    const place = document.getElementById('hand');
    for (const [name, unit, most] of
      [['force', 'N', 5], ['torque', 'N m', 2]]) {
      const slider = element('input', { type: 'range', min: -most, max: most,
        step: most / 100, value: 0, ariaLabel: `${name} by hand [${unit}]` });
      const told = element('output', {}, '0');
      slider.oninput = () => this.#set(name, Number(slider.value));
      slider.ondblclick = () => this.#set(name, 0);
      this[name] = { slider, told };
      place.append(element('span', {}, name), slider, told,
        element('span', { className: 'unit' }, unit));
    }
  }

  #set(name, value) {
    this.values[name] = value;
    this.show(this.values);
    this.push(this.values.force, this.values.torque);
  }

  show(values) {
    this.values = { force: values.force, torque: values.torque };
    for (const name of ['force', 'torque']) {
      this[name].slider.value = values[name];
      this[name].told.textContent = values[name].toFixed(2);
    }
  }
}
