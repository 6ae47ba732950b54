"use strict";
// The film of an impact: the section of the particle in colours beside its force-displacement curve, nothing from the network.
(() => {
  const $ = (id) => document.getElementById(id);
  const film = JSON.parse($("data").textContent);
  const [view, curve] = [$("view"), $("curve")];
  if (!film.frames.length) { $("failed").textContent = "No picture of this impact was taken."; $("failed").hidden = false; return; }

  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const kept = new Map();
  const once = (key, make) => { if (!kept.has(key)) kept.set(key, make()); return kept.get(key); };
  const placesOf = (k, what) => once(`${what} ${k}`, () => new Uint16Array(bytes(film.frames[k][what]).buffer));
  const levelsOf = (k, q) => once(`level ${q} ${k}`, () => bytes(film.frames[k].levels[q]));
  const step = film.edge / 65535;

  // ---- colours ------------------------------------------------------------------------------------------------
  const colour = (level) => {
    const place = level * (film.colours.length - 1);
    const low = Math.min(Math.floor(place), film.colours.length - 2);
    const mix = (c) => Math.round(255 * (film.colours[low][c] * (1 - place + low) + film.colours[low + 1][c] * (place - low)));
    return `rgb(${mix(0)},${mix(1)},${mix(2)})`;
  };
  const palette = Array.from({ length: 256 }, (_, i) => colour(i / 255));
  const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const prefixes = [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"]];
  const told = (value, unit) => {
    if (value === 0) return `0 ${unit}`.trim();
    if (!unit) return Number(value.toPrecision(3)).toString();
    const [factor, prefix] = unit === "K" ? [1, ""] : prefixes.find(([f]) => Math.abs(value) >= f) || prefixes[prefixes.length - 1];
    return `${Number((value / factor).toPrecision(3))} ${prefix}${unit}`;
  };

  // ---- view ---------------------------------------------------------------------------------------------------
  let [now, quantity, playing] = [0, 0, false];
  const eye = { zoom: 1, x: 0, y: 0 };
  const sized = (canvas) => {
    const sharp = window.devicePixelRatio || 1;
    const [w, h] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(w * sharp) || canvas.height !== Math.round(h * sharp)) {
      canvas.width = Math.round(w * sharp);
      canvas.height = Math.round(h * sharp);
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(sharp, 0, 0, sharp, 0, 0);
    pen.clearRect(0, 0, w, h);
    return [pen, w, h];
  };
  const farthest = film.frames.reduce((far, _, k) => placesOf(k, "surface").reduce((most, count, i) => (i % 3 ? most : Math.max(most, count)), far), 0);
  const broad = film.mirrored ? 2 * (farthest * step + film.low[0]) || film.edge : film.edge;
  /** Pixels a metre, and where the wall meets the axis. */
  const frame = (w, h) => {
    // on a narrow screen curve and legend stand above and below the particle, not beside it
    const narrow = w <= 640 && h >= 620;
    const foot = document.querySelector(".controls").offsetHeight + 40 + (narrow ? $("legend").offsetHeight + 10 : 0);
    const head = narrow ? curve.offsetTop + curve.offsetHeight + 10 : 60;
    const scale = 0.86 * Math.min(w / broad, Math.max(h - foot - head, 0.3 * h) / film.edge) * eye.zoom;
    const middle = film.mirrored ? 0 : film.low[0] + 0.5 * film.edge;
    return { scale, x: 0.5 * w + eye.x - middle * scale, y: h - foot - 26 + eye.y };
  };
  const sides = film.mirrored ? [1, -1] : [1];
  const drawBody = () => {
    const [pen, w, h] = sized(view);
    const { scale, x, y } = frame(w, h);
    pen.fillStyle = ink("--line");
    pen.fillRect(0, y, w, 6);
    const [places, surface] = [placesOf(now, "places"), placesOf(now, "surface")];
    // in three dimensions the surface that may meet the wall is known alone
    const top = (counts) => { let most = 0; for (let i = 1; i < counts.length; i += 3) most = Math.max(most, counts[i]); return most; };
    const whole = surface.length > 0 && top(surface) >= top(places);
    const outline = new Path2D();
    for (const side of sides) {
      for (let i = 0, n = surface.length / 3; i < n; i++) {
        const r = surface[3 * i] * step + film.low[0], z = surface[3 * i + 1] * step + film.low[1];
        // points of the surface end beside the axis
        if (i === 0) outline.moveTo(film.mirrored ? x : x + r * scale, y - z * scale);
        outline.lineTo(x + side * r * scale, y - z * scale);
        if (i === n - 1 && film.mirrored && whole) outline.lineTo(x, y - z * scale);
      }
    }
    const levels = film.scales.length ? levelsOf(now, quantity) : null;
    const plain = ink("--accent");
    pen.save();
    if (whole) pen.clip(outline);
    // points stand for patches that may be oblong: wide ones first close the gaps between them
    for (const share of [whole ? 2.6 : 1.4, 1.08]) {
      for (let i = 0, n = places.length / 3; i < n; i++) {
        const r = places[3 * i] * step + film.low[0], z = places[3 * i + 1] * step + film.low[1];
        const size = Math.max(places[3 * i + 2] * step * scale * share, 1);
        pen.fillStyle = levels ? palette[levels[i]] : plain;
        for (const side of sides) pen.fillRect(x + side * r * scale - 0.5 * size, y - z * scale - 0.5 * size, size, size);
      }
    }
    pen.restore();
    pen.strokeStyle = ink("--ink");
    pen.lineWidth = 1.2;
    pen.stroke(outline);
    const nice = [1, 2, 5].flatMap((d) => Array.from({ length: 16 }, (_, p) => d * 10 ** (p - 12))).sort((a, b) => a - b);
    const length = nice.filter((l) => l * scale <= 130).pop() || nice[0];
    $("length").textContent = told(length, "m");
    $("bar").style.width = `${length * scale}px`;
  };
  const drawCurve = () => {
    const [pen, w, h] = sized(curve);
    if (film.curve.length < 2) return;
    const [left, right, top, low] = [12, 12, 22, 26];
    const most = (c) => Math.max(...film.curve.map((row) => row[c]), Number.MIN_VALUE);
    const [far, strong] = [most(1), most(2)];
    const at = (row) => [left + (w - left - right) * Math.max(row[1], 0) / far, h - low - (h - top - low) * Math.max(row[2], 0) / strong];
    pen.font = "12px system-ui, sans-serif";
    pen.fillStyle = pen.strokeStyle = ink("--ink");
    pen.fillText(`F, up to ${told(strong, "N")}`, left, 15);
    const words = `δ, up to ${told(far, "m")}`;
    pen.fillText(words, w - right - pen.measureText(words).width, h - 9);
    pen.globalAlpha = 0.35;
    pen.strokeRect(left, top, w - left - right, h - top - low);
    pen.globalAlpha = 1;
    pen.beginPath();
    film.curve.forEach((row) => pen.lineTo(...at(row)));
    pen.strokeStyle = ink("--accent");
    pen.lineWidth = 1.6;
    pen.stroke();
    const time = film.frames[now].time;
    const row = film.curve.reduce((best, row) => (Math.abs(row[0] - time) < Math.abs(best[0] - time) ? row : best));
    pen.beginPath();
    pen.arc(...at(row), 5, 0, 7);
    pen.fill();
  };
  const draw = () => {
    drawBody();
    drawCurve();
    $("frame").value = now;
    $("clock").textContent = `${told(film.frames[now].time, "s")}  (${now + 1} of ${film.frames.length})`;
  };

  // ---- controls -----------------------------------------------------------------------------------------------
  const legend = () => {
    const scale = film.scales[quantity];
    $("legend").hidden = !scale;
    if (!scale) return;
    $("quantity").textContent = scale.name;
    const pen = $("scale").getContext("2d");
    for (let i = 0; i < 208; i++) { pen.fillStyle = colour(i / 207); pen.fillRect(i, 0, 1, 12); }
    $("ticks").replaceChildren(...[0, 0.5, 1].map((part) => {
      const tick = document.createElement("span");
      tick.textContent = told(scale.low + part * (scale.high - scale.low), scale.unit);
      return tick;
    }));
  };
  film.scales.forEach((scale, i) => $("colour").append(new Option(scale.name, i)));
  $("colour").onchange = () => { quantity = Number($("colour").value); legend(); draw(); };
  $("frame").max = film.frames.length - 1;
  const show = (k) => { now = Math.max(0, Math.min(film.frames.length - 1, k)); draw(); };
  $("frame").oninput = () => show(Number($("frame").value));
  const run = () => {
    if (!playing) return;
    if (now + 1 >= film.frames.length) return pause();
    show(now + 1);
    setTimeout(run, 90);
  };
  const pause = () => { playing = false; $("play").textContent = "Play"; };
  $("play").onclick = () => {
    if (playing) return pause();
    playing = true;
    $("play").textContent = "Pause";
    if (now + 1 >= film.frames.length) now = -1;
    run();
  };
  $("reset").onclick = () => { Object.assign(eye, { zoom: 1, x: 0, y: 0 }); draw(); };
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    const before = frame(view.clientWidth, view.clientHeight);
    const factor = Math.exp(-0.0015 * event.deltaY);
    const zoom = Math.max(0.5, Math.min(200, eye.zoom * factor));
    const real = zoom / eye.zoom;
    eye.zoom = zoom;
    eye.x += (event.clientX - before.x) * (1 - real);
    eye.y += (event.clientY - before.y) * (1 - real);
    draw();
  }, { passive: false });
  const fingers = new Map();
  view.addEventListener("pointerdown", (event) => { view.setPointerCapture(event.pointerId); fingers.set(event.pointerId, [event.clientX, event.clientY]); });
  view.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (!last) return;
    const there = [event.clientX, event.clientY];
    if (fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      const gap = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      eye.zoom = Math.max(0.5, Math.min(200, eye.zoom * gap(there) / gap(last)));
    } else {
      eye.x += there[0] - last[0];
      eye.y += there[1] - last[1];
    }
    fingers.set(event.pointerId, there);
    draw();
  });
  for (const end of ["pointerup", "pointercancel"]) view.addEventListener(end, (event) => fingers.delete(event.pointerId));
  view.addEventListener("keydown", (event) => {
    const move = { ArrowRight: 1, ArrowLeft: -1, PageDown: 10, PageUp: -10 }[event.key];
    if (move) { event.preventDefault(); show(now + move); }
    if (event.key === " ") { event.preventDefault(); $("play").click(); }
  });
  const resize = () => {
    const set = (name, of) => document.documentElement.style.setProperty(name, `${document.querySelector(of).offsetHeight}px`);
    set("--low", ".controls");
    set("--head", "header");
    draw();
  };
  addEventListener("resize", resize);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);

  // opens at the largest force
  const peak = film.curve.reduce((best, row) => (row[2] > best[2] ? row : best), film.curve[0] || [0, 0, 0]);
  now = film.frames.reduce((best, f, k) => (Math.abs(f.time - peak[0]) < Math.abs(film.frames[best].time - peak[0]) ? k : best), 0);
  legend();
  resize();
})();
