// What a pointer does in the drawings: drags the time, holds the slider or the
// disc, turns the space. `page` is what of the page it acts on.
import { AT } from './core.mjs';

const HAND = { spring: 40, damper: 6, brake: 1.5, force: 20, torque: 6 };

export function dragTime(strips, page) {
  const { motion } = page, { canvas } = strips.sheet;
  let isDown = false;
  const scrub = (place) => page.seek(Math.min(strips.time(place.x) / motion.dt,
    Math.max(motion.last, motion.tick)));
  canvas.onpointerdown = (event) => {
    const place = strips.sheet.place(event), mark = strips.markAt(place);
    page.play(false);
    if (page.isLive()) return undefined;
    if (mark) return page.openAt(mark.tick);
    page.showFan(null);
    isDown = true;
    canvas.setPointerCapture(event.pointerId);
    return scrub(place);
  };
  canvas.onpointermove = (event) => {
    const place = strips.sheet.place(event);
    if (isDown) return scrub(place);
    const mark = strips.markAt(place);
    canvas.style.cursor = mark ? 'pointer' : '';
    if (mark && !page.isLive()) page.showFan(mark.tick);
    return undefined;
  };
  canvas.onpointerup = canvas.onpointercancel = () => { isDown = false; };
}

// Returns: what pulls at the motion, once a frame.
export function holdMachine(mechanism, page) {
  const { motion } = page, { canvas } = mechanism.sheet;
  let held = null;
  canvas.onpointerdown = (event) => {
    const place = mechanism.sheet.place(event);
    held = page.isLive() ? null : mechanism.hold(place, motion.now);
    if (!held) return;
    Object.assign(held, place, { turn: 0, angle: mechanism.angle(place),
      at: event.timeStamp });
    canvas.setPointerCapture(event.pointerId);
    canvas.classList.add('held');
    page.showFan(null);
    page.play(true);
  };
  canvas.onpointermove = (event) => {
    if (!held) return;
    const place = mechanism.sheet.place(event), angle = mechanism.angle(place);
    const seconds = Math.max(1e-3, (event.timeStamp - held.at) / 1000);
    const turned = Math.atan2(Math.sin(angle - held.angle),
      Math.cos(angle - held.angle));
    Object.assign(held, place, { angle, at: event.timeStamp,
      turn: turned / seconds });
  };
  canvas.onpointerup = canvas.onpointercancel = () => {
    if (!held) return;
    held = null;
    canvas.classList.remove('held');
    page.push(0, 0);
  };
  // In thousandths, so that the address stays short.
  const within = (x, most) =>
    Math.round(1000 * Math.max(-most, Math.min(most, x))) / 1000;
  // A pointer that holds the slider pulls it by a spring with a damper; one
  // that holds the disc turns it by a brake.
  return () => {
    if (!held) return;
    const row = motion.now;
    if (held.part === 'slider') {
      const away = mechanism.along(held, row, held.lens) - row[AT.r];
      motion.drive(within(HAND.spring * away - HAND.damper * row[AT.v],
        HAND.force), 0);
    } else {
      motion.drive(0, within(HAND.brake * (held.turn - row[AT.omega]),
        HAND.torque));
      held.turn *= 0.7;
    }
  };
}

// A pointer or the arrow keys turn the space; a double click shows it from
// above.
export function turnSpace(space) {
  const { canvas } = space.sheet;
  const turn = (x, y) => space.see(space.round + x, space.tilt + y);
  let last = null;
  canvas.onpointerdown = (event) => {
    last = space.sheet.place(event);
    canvas.setPointerCapture(event.pointerId);
  };
  canvas.onpointermove = (event) => {
    if (!last) return;
    const { x, y } = space.sheet.place(event);
    turn(0.008 * (x - last.x), 0.008 * (y - last.y));
    last = { x, y };
  };
  canvas.onpointerup = canvas.onpointercancel = () => { last = null; };
  canvas.ondblclick = () => space.see();
  canvas.onkeydown = (event) => {
    const way = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0],
      ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    turn(...way);
  };
}
