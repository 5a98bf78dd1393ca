// The page of a lesson. In: its elements, the name of the lesson and the hash of its picture. Out: the picture as the
// program draws it in its worker; as it was at each step; what happened to a pixel that is clicked. The address may say
// #step=12&pixel=160,90. The title ends with the hash when all of that is shown.
const element = name => document.getElementById(name);
const { name, hash: native } = JSON.parse(element('known').textContent);
const canvas = element('picture'), slider = element('step'), pen = canvas.getContext('2d');
const worker = new Worker(URL.createObjectURL(new Blob([element('worker').textContent], { type: 'text/javascript' })));
const waiting = new Map(), pictures = new Map();
let number = 0, picture, steps = [], shown, marked = null, wanted = null, busy = false;

worker.onmessage = ({ data }) => {
    waiting.get(data.number)(data);
    waiting.delete(data.number);
};
worker.onerror = error => { element('status').textContent = `The worker failed: ${error.message}`; };

/** One run of the program; its files. */
function ask(...words) {
    return new Promise((resolve, reject) => {
        waiting.set(++number, done => done.status === 0 ? resolve(done) : reject(new Error(done.text)));
        const program = number === 1 ? element('program').textContent : undefined;
        worker.postMessage({ program, number, words: [name, ...words.map(String)] });
    });
}

const text_of = bytes => new TextDecoder().decode(bytes);

/** The picture, and a frame around the pixel that is explained. */
function paint() {
    canvas.width = shown.width;
    canvas.height = shown.height;
    pen.drawImage(shown, 0, 0);
    if (marked === null) return;
    for (const [color, far] of [['#000', 2.5], ['#fff', 1.5]]) {
        pen.strokeStyle = color;
        pen.strokeRect(marked[0] - far + 0.5, marked[1] - far + 0.5, 2 * far, 2 * far);
    }
}

/** The PNG of a step, drawn when it is looked at for the first time. */
async function draw_step({ command, moment, file }) {
    const out = { moment: `/moment${file}`, views: '/view', draw: '/picture' }[command];
    const path = (command === 'views' ? out + file : out) + '.png';
    if (!pictures.has(path)) {
        const words = command === 'draw' ? [] : [...(command === 'moment' ? [moment] : []), ...picture];
        for (const [made, bytes] of (await ask(command, out, ...words)).files) pictures.set(made, bytes);
    }
    return createImageBitmap(new Blob([pictures.get(path)], { type: 'image/png' }));
}

/** The step at which the slider stands; of several that it passed meanwhile the last. */
async function show_step(index) {
    wanted = index;
    if (busy) return;
    busy = true;
    try {
        while (wanted !== null) {
            const at = wanted;
            wanted = null;
            element('label').textContent = `${at + 1} of ${steps.length}: ${steps[at].text} …`;
            shown = await draw_step(steps[at]);
            paint();
            element('label').textContent = `${at + 1} of ${steps.length}: ${steps[at].text}`;
        }
    } catch (error) {
        element('label').textContent = error.message;
    }
    busy = false;
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
    const facts = JSON.parse(text_of(drawn.files.get('/picture.json')));
    picture = facts.picture;
    pictures.set('/picture.png', drawn.files.get('/picture.png'));
    shown = await draw_step({ command: 'draw', file: '' });
    paint();
    const same = facts.hash === native ? 'the native program draws the same' : `the native program draws ${native}`;
    element('status').textContent =
        `${facts.hash}: ${same}. Drawn here in ${Math.round(performance.now() - begun)} ms, ${facts.width} × ${facts.height}.`;
    element('output').textContent = drawn.text;
    steps = JSON.parse(text_of((await ask('steps', '/steps', ...picture)).files.get('/steps.json'))).steps;
    slider.max = steps.length - 1;
    slider.value = steps.length - 1;
    slider.disabled = false;
    element('label').textContent = `${steps.length} of ${steps.length}: ${steps.at(-1).text}`;
    const asked = new URLSearchParams(location.hash.slice(1));
    if (asked.has('step')) await go(Number(asked.get('step')) - 1);
    if (asked.has('pixel')) await explain(...asked.get('pixel').split(',').map(Number));
    document.title += ` ${facts.hash}`;
}

slider.oninput = () => show_step(Number(slider.value));
element('back').onclick = () => go(Number(slider.value) - 1);
element('next').onclick = () => go(Number(slider.value) + 1);
canvas.onclick = event => {
    const box = canvas.getBoundingClientRect();
    if (steps.length > 0) explain(Math.floor((event.clientX - box.left) / box.width * canvas.width),
        Math.floor((event.clientY - box.top) / box.height * canvas.height));
};
begin().catch(error => { element('status').textContent = `The lesson did not draw: ${error.message}`; });
