// The plan: trajectory, objects and what the sonar looks at, y up.

const plan = movable($('plan'), draw_plan, (x, y) => select(smallest_at(plan.areas, x, y)));
plan.areas = [];  // of the objects on the canvas
plan.names = [];  // that are written

// R = Rz(yaw) Ry(pitch) Rx(roll), degrees.
function rotation(roll, pitch, yaw) {
  const [a, b, c] = [roll, pitch, yaw].map(angle => angle * Math.PI / 180);
  const [sa, ca, sb, cb, sc, cc] = [Math.sin(a), Math.cos(a), Math.sin(b), Math.cos(b), Math.sin(c), Math.cos(c)];
  return [[cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
          [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
          [-sb, cb * sa, cb * ca]];
}
const turn = (matrix, v) => matrix.map(row => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);

// What the sonar looks at, at its greatest range: points of the world's x and y, the sonar first.
function footprint(one, index) {
  const vehicle = rotation(track.roll[index], track.pitch[index], track.yaw[index]);
  const at = turn(vehicle, one.mount.position).map((d, k) => d + [track.x, track.y, track.z][k][index]);
  const head = (one.columns.head_angle_rad || [])[index / one.every] || 0;
  const points = [[at[0], at[1]]];
  for (let k = -16; k <= 16; ++k) {
    let ray;
    if (one.is_cone) {
      const around = Math.PI * k / 16;
      const [sine, cosine] = [Math.sin(one.azimuth / 2), Math.cos(one.azimuth / 2)];
      ray = [cosine, sine * Math.cos(around), sine * Math.sin(around)];
    } else {
      const angle = head + one.azimuth / 2 * k / 16;
      ray = [Math.cos(angle), Math.sin(angle), 0];
    }
    const [x, y] = turn(vehicle, turn(one.mount.rotation, ray.map(d => d * one.range)));
    points.push([at[0] + x, at[1] + y]);
  }
  return points;
}

function bounds_of_dataset() {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x, y) => {
    box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y);
  };
  track.x.forEach((x, k) => add(x, track.y[k]));
  for (const one of data.sensors) {
    const stride = Math.max(1, Math.floor(one.pings / 50));
    for (let ping = 0; ping < one.pings; ping += stride)
      footprint(one, ping * one.every).forEach(([x, y]) => add(x, y));
  }
  return box;
}

// The outlines of the objects whose classes are on. The ground, beyond the plan on all sides, has none.
function draw_objects(context, px) {
  const [low_x, low_y, high_x, high_y] = plan.bounds;
  plan.areas = [];
  const names = [];
  data.labels.forEach(({min, max}, label) => {
    if (!min || state.hidden.has(class_of(label))) return;
    if (max[0] - min[0] > high_x - low_x && max[1] - min[1] > high_y - low_y) return;
    const [[left, bottom], [right, top]] = [px(...min), px(...max)];
    const is_selected = label === state.selected;
    const colour = is_selected ? '#fff' : colour_of(label);
    plan.areas.push([left, top, right, bottom, label]);
    names.push({text: data.labels[label].name, box: [left, top, right, bottom], colour, is_selected});
    context.strokeStyle = colour;
    context.lineWidth = is_selected ? 2 : 1;
    context.strokeRect(left, top, right - left, bottom - top);
  });
  names.sort((a, b) => b.is_selected - a.is_selected);
  return names;
}

function draw_plan() {
  const context = plan.fit();
  const {width, height} = plan.canvas;
  const [low_x, low_y, high_x, high_y] = plan.bounds;
  const size = Math.max(1e-3, (high_x - low_x) / width, (high_y - low_y) / height) * 1.1;
  const index = pose();
  plan.span = [1, 1];
  const scale = plan.zoom / size;
  if ($('follow').checked && plan.zoom > 1) {
    plan.x = 0.5 + (track.x[index] - (low_x + high_x) / 2) / (size * width);
    plan.y = 0.5 - (track.y[index] - (low_y + high_y) / 2) / (size * height);
  }
  const mid_x = (low_x + high_x) / 2 + (plan.x - 0.5) * size * width;
  const mid_y = (low_y + high_y) / 2 - (plan.y - 0.5) * size * height;
  const px = (x, y) => [width / 2 + (x - mid_x) * scale, height / 2 - (y - mid_y) * scale];
  const line = points => {
    context.beginPath();
    points.forEach(([x, y], k) => context[k ? 'lineTo' : 'moveTo'](...px(x, y)));
  };
  context.font = '11px system-ui, sans-serif';
  context.lineWidth = 1;
  const names = draw_objects(context, px);
  context.lineWidth = 1;
  context.strokeStyle = '#9a9aa4';
  const stride = Math.max(1, Math.floor(track.x.length / 20000));
  const path = [];
  for (let k = 0; k < track.x.length; k += stride) path.push([track.x[k], track.y[k]]);
  line(path);
  context.stroke();
  context.strokeStyle = context.fillStyle = colours[state.sensor % colours.length];
  line(footprint(sensor(), index));
  context.closePath();
  context.globalAlpha = 0.2;
  context.fill();
  context.globalAlpha = 1;
  context.stroke();
  context.fillStyle = '#fff';
  const [x, y] = px(track.x[index], track.y[index]);
  context.fillRect(x - 3, y - 3, 6, 6);
  const bar = 10 ** Math.floor(Math.log10(size * width / plan.zoom / 2));
  context.fillRect(10, height - 12, bar * scale, 3);
  context.fillText(`${bar} m`, 14 + bar * scale, height - 8);
  plan.names = place_names(context, names, 11, width, height);
  write_names(context, plan.names);
}
