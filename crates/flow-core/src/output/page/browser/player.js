// The player: slider, play and pause, speed and keys.

/** Frames per second at speed 1. */
const PACE = 24;
const SIGNS = { play: "M3 1.5v13l11-6.5z", pause: "M3 2h3.5v12H3zM9.5 2H13v12H9.5z" };

class Player {
  /** `show(frame)` is called for every frame to be shown. */
  constructor(record, show) {
    Object.assign(this, { record, show, frame: 0, clock: null });
    const find = (id) => document.getElementById(id);
    [this.button, this.sign, this.slider, this.speed, this.now] = ["play", "play-sign", "slider", "speed", "now"].map(find);
    this.slider.max = record.frames - 1;
    this.slider.disabled = this.button.disabled = record.frames < 2;
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.button.addEventListener("click", () => this.toggle());
    document.addEventListener("keydown", (event) => this.key(event));
  }

  get playing() {
    return this.clock !== null;
  }

  /** Shows a frame, or the end nearest to it; whoever asks for one takes over from the clock. */
  go(frame) {
    this.stop();
    this.set(frame);
  }

  set(frame) {
    const { record, slider } = this;
    this.frame = Math.max(0, Math.min(record.frames - 1, frame));
    slider.value = this.frame;
    const text = `frame ${this.frame + 1} of ${record.frames}, t = ${written(record.time[this.frame])}`;
    slider.setAttribute("aria-valuetext", text);
    this.now.textContent = text;
    this.show(this.frame);
  }

  toggle() {
    if (this.playing) return this.stop();
    if (this.record.frames < 2) return;
    if (this.frame === this.record.frames - 1) this.set(0);
    this.clock = { last: null, due: 0 };
    this.dress();
    requestAnimationFrame((time) => this.tick(time));
  }

  stop() {
    this.clock = null;
    this.dress();
  }

  tick(time) {
    const { clock } = this;
    if (!clock) return;
    // After a pause of the browser the clock goes on, it does not catch up.
    const passed = clock.last === null ? 0 : Math.min(time - clock.last, 100);
    clock.last = time;
    clock.due += (passed / 1000) * PACE * Number(this.speed.value);
    const steps = Math.floor(clock.due);
    clock.due -= steps;
    if (steps > 0) this.set(this.frame + steps);
    if (this.frame === this.record.frames - 1) return this.stop();
    requestAnimationFrame((next) => this.tick(next));
  }

  dress() {
    this.sign.setAttribute("d", this.playing ? SIGNS.pause : SIGNS.play);
    this.button.setAttribute("aria-label", this.playing ? "pause" : "play");
  }

  key(event) {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    // Menus, buttons and texts have a use for these keys themselves; the slider does what the page does.
    const own = event.key === " " ? "select, button, summary, input[type=checkbox]" : "select, pre";
    if (event.target.matches?.(own)) return;
    const far = event.shiftKey ? 10 : 1;
    const frames = { ArrowLeft: this.frame - far, ArrowRight: this.frame + far, Home: 0, End: this.record.frames - 1 };
    if (event.key === " ") this.toggle();
    else if (event.key in frames) this.go(frames[event.key]);
    else return;
    event.preventDefault();
  }
}
