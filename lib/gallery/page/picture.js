// The picture of a view, with boxes and masks over it and a mark where the ping is.

const picture = movable($('picture'), draw_picture, (x, y) => select(smallest_at(picture.areas, x, y)));
picture.areas = [];  // of the boxes on the canvas
picture.names = [];  // that are written

function draw_masks(context, boxes, shown) {
  const [origin, size] = [shown.origin || [0, 0], shown.pixel || [1, 1]];
  context.globalAlpha = 0.4;
  context.imageSmoothingEnabled = false;
  for (const box of boxes) {
    if (!box[5].mask) continue;
    const {canvas, left, top, is_empty} = mask_of(box, shown);
    if (is_empty) continue;
    context.drawImage(canvas, origin[0] + left * size[0], origin[1] + top * size[1],
                      canvas.width * size[0], canvas.height * size[1]);
  }
  context.globalAlpha = 1;
}

// The box of a shadow is dashed.
function draw_boxes(context, boxes, pixel) {
  for (const [label, x, y, width, height, details] of boxes) {
    const is_selected = label === state.selected;
    context.strokeStyle = is_selected ? '#fff' : colour_of(label);
    context.lineWidth = (is_selected ? 3 : 2) * pixel;
    context.strokeRect(x, y, width, height);
    if (!details.shadow_bbox) continue;
    context.setLineDash([4 * pixel, 4 * pixel]);
    context.lineWidth = pixel;
    context.strokeRect(...details.shadow_bbox);
    context.setLineDash([]);
  }
}

// The box on the canvas: [left, top, right, bottom, label].
function area_of([label, x, y, width, height], matrix) {
  const corners = [[x, y], [x + width, y + height]].map(([u, v]) => matrix.transformPoint({x: u, y: v}));
  const [xs, ys] = [corners.map(c => c.x), corners.map(c => c.y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys), label];
}

// Small boxes get their names first, the selected one before all.
function name_boxes(context, boxes) {
  const matrix = context.getTransform();
  const {width, height} = picture.canvas;
  picture.areas = boxes.map(box => area_of(box, matrix));
  const rank = area => area[4] === state.selected ? -1 : (area[2] - area[0]) * (area[3] - area[1]);
  const names = [...picture.areas].sort((a, b) => rank(a) - rank(b)).map(area => ({
    text: label_text(area[4]), box: area,
    colour: area[4] === state.selected ? '#fff' : colour_of(area[4])}));
  context.setTransform(1, 0, 0, 1, 0, 0);
  const line = 13 * (window.devicePixelRatio || 1);
  context.font = `${line}px system-ui, sans-serif`;
  picture.names = place_names(context, names, line, width, height);
  write_names(context, picture.names);
}

// Where the ping is in a picture of many.
function draw_mark(context, shown, image, pixel) {
  context.strokeStyle = '#78cdeb';
  context.lineWidth = pixel;
  context.beginPath();
  if (shown.per === 'sweep') {
    const angle = (sensor().columns.head_angle_rad || [])[state.ping];
    if (angle === undefined || angle === null) return;
    const radius = shown.radius * image.naturalWidth;
    const [x, y] = [0.5 * image.naturalWidth, radius];
    context.moveTo(x, y);
    context.lineTo(x - radius * Math.sin(angle), y - radius * Math.cos(angle));
  } else if (shown.along === 'y') {
    const y = shown.origin[1] + (state.ping + 0.5) * shown.step[1];
    context.moveTo(0, y);
    context.lineTo(image.naturalWidth, y);
  } else if (shown.along === 'x') {
    const x = shown.origin[0] + (state.ping + 0.5) * shown.step[0];
    context.moveTo(x, 0);
    context.lineTo(x, image.naturalHeight);
  }
  context.stroke();
}

function draw_picture() {
  const shown = view();
  const image = shown && image_of(url_of(shown, state.ping));
  if (image && !image.done) return;  // until then the last picture stays
  const context = picture.fit();
  picture.areas = picture.names = [];
  $('seen').textContent = '';
  if (!shown) return;
  const {width, height} = picture.canvas;
  if (!image.naturalWidth) {
    context.fillStyle = '#f0c060';
    context.font = '16px system-ui, sans-serif';
    context.fillText(`${url_of(shown, state.ping)} is not there: not rendered yet, or removed`, 20, 40);
    return;
  }
  const fit = Math.min(width / image.naturalWidth, height / image.naturalHeight);
  const scale = fit * picture.zoom;
  picture.span = [width / (fit * image.naturalWidth), height / (fit * image.naturalHeight)];
  context.translate(width / 2, height / 2);
  context.scale(scale, scale);
  context.translate(-picture.x * image.naturalWidth, -picture.y * image.naturalHeight);
  if (shown.turned) {
    context.translate(image.naturalWidth, image.naturalHeight);
    context.rotate(Math.PI);
  }
  context.imageSmoothingEnabled = scale < 2;
  context.filter = $('bright').value === '1' ? 'none' : `brightness(${$('bright').value})`;
  context.drawImage(image, 0, 0);
  context.filter = 'none';
  draw_mark(context, shown, image, 1 / scale);
  if (!shown.boxes) return;
  const boxes = shown_boxes();
  if ($('masks').checked) draw_masks(context, boxes, shown);
  if (!$('boxes').checked) return;
  draw_boxes(context, boxes, 1 / scale);
  name_boxes(context, boxes);
  const names = boxes.map(box => label_text(box[0]));
  const word = names.length === 1 ? 'box' : 'boxes';
  $('seen').textContent = `${names.length} ${word}${names.length ? ': ' : ''}${names.join(', ')}`;
}
