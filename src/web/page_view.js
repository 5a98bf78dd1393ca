// The page of a lesson. In: its elements, the name of the lesson and the hash of its picture. Out: the picture as the
// program draws it in a worker; as it was at each step; what happened to a pixel that is clicked. The address may say
// #step=12&pixel=160,90. The title ends with the hash once the picture is drawn; the body says when all of it is there.
const element = name => document.getElementById(name);
const { name, hash: native } = JSON.parse(element('known').textContent);
const canvas = element('picture'), slider = element('step'), pen = canvas.getContext('2d');
const waiting = new Map(), pictures = new Map();
let number = 0, facts, picture, steps = [], at = 0, shown, marked = null, wanted = null, busy = false;

function make_worker() {
    const script = new Blob([element('worker').textContent], { type: 'text/javascript' });
    const worker = new Worker(URL.createObjectURL(script));
    worker.onmessage = ({ data }) => {
        waiting.get(data.number)(data);
        waiting.delete(data.number);
    };
    worker.onerror = error => { element('status').textContent = `The worker failed: ${error.message}`; };
    worker.is_new = true;
    return worker;
}

/** The second one makes the pictures of the stages, so that nobody waits for them. */
const workers = { draw: make_worker() };

/** One run of the program; its files. */
function ask(...words) {
    const worker = words[0] === 'stages' ? workers.stages ??= make_worker() : workers.draw;
    return new Promise((resolve, reject) => {
        waiting.set(++number, done => done.status === 0 ? resolve(done) : reject(new Error(done.text)));
        const program = worker.is_new ? element('program').textContent : undefined;
        worker.is_new = false;
        worker.postMessage({ program, number, words: [name, ...words.map(String)] });
    });
}

const text_of = bytes => new TextDecoder().decode(bytes);

/** Whether a step's picture has the pixels of the lesson's at their places. */
const has_pixels = step => !/^\/stages-(mesh|vertex|clip|coverage-detail|level-.*|texture-.*)\.png$/.test(step?.file);

/** The picture, and a frame around the pixel that is explained. */
function paint() {
    canvas.width = shown.width;
    canvas.height = shown.height;
    pen.drawImage(shown, 0, 0);
    const zoom = shown.width / facts.width;
    if (marked === null || !has_pixels(steps[at])) return;
    pen.lineWidth = zoom;
    for (const [color, far] of [['#000', 2.5], ['#fff', 1.5]]) {
        pen.strokeStyle = color;
        pen.strokeRect((marked[0] - far + 0.5) * zoom, (marked[1] - far + 0.5) * zoom, 2 * far * zoom, 2 * far * zoom);
    }
}

/** The PNG of a step; of a moment, drawn when it is looked at for the first time. */
async function draw_step({ moment, file }) {
    if (!pictures.has(file)) keep(await ask('moment', file.slice(0, -4), moment, ...picture));
    return createImageBitmap(new Blob([pictures.get(file)], { type: 'image/png' }));
}

function keep({ files }) {
    for (const [file, bytes] of files) pictures.set(file, bytes);
    return files;
}

/** What the picture of a step shows: its text, the colours that it has. */
function tell() {
    const { title, text, source, scale, legend = [] } = steps[at], color = numbers => `rgb(${numbers.join(',')})`;
    const make = (tag, words) => Object.assign(document.createElement(tag), { textContent: words });
    const parts = legend.map(row => {
        const part = make('span', row.text), swatch = make('i', '');
        swatch.style.background = color(row.color);
        part.prepend(swatch);
        return part;
    });
    if (scale) {
        const bar = make('b', '');
        bar.style.background = `linear-gradient(90deg,${scale.colors.map(color).join()})`;
        parts.push(make('span', String(+scale.low.toPrecision(4))), bar,
            make('span', +scale.high.toPrecision(4) + (scale.logarithmic ? ' (logarithmic)' : '')));
    }
    element('label').replaceChildren(make('strong', `${at + 1} of ${steps.length}: ${title}. `), text,
        ...(source ? [make('code', ` ${source}`)] : []));
    element('legend').replaceChildren(...parts);
}

/** The step at which the slider stands; of several that it passed meanwhile the last. */
async function show_step(index) {
    wanted = index;
    if (busy) return;
    busy = true;
    try {
        while (wanted !== null) {
            at = wanted;
            wanted = null;
            shown = await draw_step(steps[at]);
            paint();
            tell();
        }
    } catch (error) {
        element('label').textContent = error.message;
    }
    busy = false;
}

/** The slider's steps; at the last one it stays at the last one. */
function offer(list) {
    at = slider.disabled || Number(slider.value) === steps.length - 1 ? list.length - 1 : Number(slider.value);
    steps = list;
    slider.max = list.length - 1;
    slider.value = at;
    slider.disabled = false;
    tell();
}

function go(index) {
    slider.value = Math.max(0, Math.min(steps.length - 1, index));
    return show_step(Number(slider.value));
}

async function explain(x, y) {
    marked = [x, y];
    paint();
    element('story').textContent = `pixel ${x},${y} …`;
    try {
        element('story').textContent = text_of((await ask('explain', '/pixel', x, y, ...picture)).files.get('/pixel.txt'));
    } catch (error) {
        element('story').textContent = error.message;
    }
}

async function begin() {
    const begun = performance.now();
    const drawn = await ask('draw', '/picture');
    facts = JSON.parse(text_of(keep(drawn).get('/picture.json')));
    picture = facts.picture;
    shown = await draw_step({ file: '/picture.png' });
    paint();
    const same = facts.hash === native ? 'the native program draws the same' : `the native program draws ${native}`;
    element('status').textContent =
        `${facts.hash}: ${same}. Drawn here in ${Math.round(performance.now() - begun)} ms, ${facts.width} × ${facts.height}.`;
    element('output').textContent = drawn.text;
    document.title += ` ${facts.hash}`;
    const list = async name => JSON.parse(text_of(keep(await ask(name, `/${name}`, ...picture)).get(`/${name}.json`))).steps
        .map(step => ({ ...step, file: `/${name}${step.file}` }));
    offer([...await list('steps'), { title: 'The picture', text: 'What the program writes.', file: '/picture.png' }]);
    const asked = new URLSearchParams(location.hash.slice(1));
    const explained = asked.has('pixel') ? explain(...asked.get('pixel').split(',').map(Number)) : null;
    if (facts.picture[2] === 0) { // by a device, whose stages record what they do: the last of them is the picture
        const stages = await list('stages');
        workers.stages.terminate();
        offer([...steps.slice(0, -1), ...stages]);
    }
    if (asked.has('step')) await go(Number(asked.get('step')) - 1);
    await explained;
    document.body.dataset.done = 'yes';
}

slider.oninput = () => show_step(Number(slider.value));
element('back').onclick = () => go(Number(slider.value) - 1);
element('next').onclick = () => go(Number(slider.value) + 1);
canvas.onclick = event => {
    const box = canvas.getBoundingClientRect();
    if (steps.length > 0 && has_pixels(steps[at])) explain(Math.floor((event.clientX - box.left) / box.width * facts.width),
        Math.floor((event.clientY - box.top) / box.height * facts.height));
};
begin().catch(error => { element('status').textContent = `The lesson did not draw: ${error.message}`; });
