// Canvases that zoom and move.

// `zoom` times the size at which all of it fits; x and y are what lies in the middle, as shares.
// `click` gets where the canvas is clicked, in its pixels.
function movable(canvas, redraw, click) {
  const area = {canvas, zoom: 1, x: 0.5, y: 0.5, span: [1, 1]};
  area.reset = () => { area.zoom = 1; area.x = area.y = 0.5; };
  area.fit = () => {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const context = canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.filter = 'none';
    context.clearRect(0, 0, width, height);
    return context;
  };
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect();
    const by = Math.exp(-event.deltaY * 0.0015);
    const zoom = Math.min(80, Math.max(1, area.zoom * by));
    const grown = 1 / area.zoom - 1 / zoom;
    area.x += ((event.clientX - box.left) / box.width - 0.5) * area.span[0] * grown;
    area.y += ((event.clientY - box.top) / box.height - 0.5) * area.span[1] * grown;
    area.zoom = zoom;
    if (zoom === 1) area.reset();
    redraw();
  }, {passive: false});
  let way = 0;  // that the pointer has moved since it went down, px
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    way = 0;
  });
  canvas.addEventListener('pointerup', event => {
    const box = canvas.getBoundingClientRect();
    if (way > 4) return;
    click((event.clientX - box.left) / box.width * canvas.width,
          (event.clientY - box.top) / box.height * canvas.height);
  });
  canvas.addEventListener('pointermove', event => {
    if (!event.buttons) return;
    way += Math.abs(event.movementX) + Math.abs(event.movementY);
    if (way <= 4) return;
    const box = canvas.getBoundingClientRect();
    area.x -= event.movementX / box.width * area.span[0] / area.zoom;
    area.y -= event.movementY / box.height * area.span[1] / area.zoom;
    redraw();
  });
  canvas.addEventListener('dblclick', () => { area.reset(); redraw(); });
  return area;
}

// The smallest of some areas, [left, top, right, bottom, what], around a point; its `what`, or -1.
function smallest_at(areas, x, y) {
  const margin = 4;
  let [best, size] = [-1, Infinity];
  for (const [left, top, right, bottom, what] of areas) {
    const is_in = x >= left - margin && x <= right + margin && y >= top - margin && y <= bottom + margin;
    const own = (right - left) * (bottom - top);
    if (is_in && own < size) [best, size] = [what, own];
  }
  return best;
}
