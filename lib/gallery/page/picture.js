// The picture of a view, with boxes over it and a mark where the ping is.

const picture = movable($('picture'), draw_picture);

function draw_boxes(context, boxes, shown, pixel) {
  const names = [];
  context.lineWidth = 2 * pixel;
  context.font = `${13 * pixel}px system-ui, sans-serif`;
  for (const [label, x, y, width, height] of boxes) {
    context.strokeStyle = context.fillStyle = colours[label % colours.length];
    context.strokeRect(x, y, width, height);
    context.save();
    // A turned picture has its lower right corner at the upper left.
    context.translate(shown.turned ? x + width : x, shown.turned ? y + height : y);
    if (shown.turned) context.rotate(Math.PI);
    context.fillText(data.labels[label], 0, -4 * pixel);
    context.restore();
    names.push(data.labels[label]);
  }
  return names;
}

function boxes_of(shown) {
  if (!shown.boxes) return [];
  if (shown.per === 'ping') return shown.boxes[state.ping] || [];
  if (shown.per === 'sweep') return shown.boxes[Math.floor(state.ping / shown.pings)];
  return shown.boxes;
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
  if ($('boxes').checked && shown.boxes) {
    const names = draw_boxes(context, boxes_of(shown), shown, 1 / scale);
    const word = names.length === 1 ? 'box' : 'boxes';
    $('seen').textContent = `${names.length} ${word}${names.length ? ': ' : ''}${names.join(', ')}`;
  }
}
