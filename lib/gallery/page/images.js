// Pictures, loaded by their relative paths, which file:// permits.

const images = new Map();  // the pictures loaded last, the oldest first
const most_images = 48;

function image_of(url) {
  let image = images.get(url);
  if (image) {
    images.delete(url);
  } else {
    image = new Image();
    image.onload = image.onerror = () => {
      image.done = true;
      if (view() && url === url_of(view(), state.ping)) draw_picture();
    };
    image.src = url;
  }
  images.set(url, image);
  if (images.size > most_images) {
    const [oldest, left] = images.entries().next().value;
    images.delete(oldest);
    if (!left.done) left.src = '';  // nobody waits for it any more
  }
  return image;
}

function numbered(pattern, number) {
  return pattern.replace(/%0(\d)d/, (_, digits) => String(number).padStart(Number(digits), '0'));
}

// Pictures of archives were copied into a folder next to the page.
const in_page = (shown, file) => shown.unpacked ? file : path_of(file);

// The file that a view shows at a ping.
function url_of(shown, ping) {
  if (shown.per === 'ping') return in_page(shown, numbered(shown.file, ping * sensor().every));
  if (shown.per === 'sweep') return path_of(numbered(shown.file, Math.floor(ping / shown.pings)));
  return path_of(shown.file);
}

// Once the steps pause: who drags the slider over a thousand pings wants none of their neighbours.
let preloading = 0;
function preload() {
  clearTimeout(preloading);
  preloading = setTimeout(load_neighbours, 40);
}

function load_neighbours() {
  const shown = view();
  if (!shown || shown.per !== 'ping') return;
  for (const step of [1, -1, 2, 3, 4, 5, -2]) {
    const ping = state.ping + step;
    if (ping >= 0 && ping < sensor().pings) image_of(url_of(shown, ping));
  }
}
