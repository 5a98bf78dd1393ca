// Pages in a headless browser: node browser.mjs BROWSER FOLDER SIZE [SCREENSHOT]. In: a chromium, a folder of its own for it, the
// window's WIDTHxHEIGHT, where a picture of the last page goes; from the input, a line each:
//   go URL          shows a page
//   click X Y       presses the mouse at a place of the window: two expressions without spaces
//   anything else   an expression of JavaScript, asked for again until it is something (5 minutes at most)
// Out: a line each with what the expressions are, as JSON. Talks by the pipe of the DevTools protocol.
import { spawn } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';

const [browser, folder, size, screenshot] = process.argv.slice(2);
const [width, height] = size.split('x').map(Number);
const child = spawn(browser, ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage',
    `--user-data-dir=${folder}`, '--remote-debugging-pipe', 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
const waiting = new Map();
let number = 0, rest = '';

child.stdio[4].setEncoding('utf8').on('data', text => {
    const messages = (rest + text).split('\0');
    rest = messages.pop();
    for (const message of messages.map(JSON.parse)) {
        waiting.get(message.id)?.(message);
        waiting.delete(message.id);
    }
});

function call(method, params = {}, sessionId = undefined) {
    return new Promise((resolve, reject) => {
        waiting.set(++number, ({ error, result }) => error ? reject(new Error(`${method}: ${error.message}`)) : resolve(result));
        child.stdio[3].write(JSON.stringify({ id: number, method, params, sessionId }) + '\0');
    });
}

const { targetId } = await call('Target.createTarget', { url: 'about:blank' });
const { sessionId } = await call('Target.attachToTarget', { targetId, flatten: true });
const page = (method, params) => call(method, params, sessionId);

async function evaluate(expression) {
    for (const end = Date.now() + 300000; Date.now() < end;) {
        const { result, exceptionDetails } = await page('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
        if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
        if (result.value) return result.value;
        await new Promise(resolve => setTimeout(resolve, 50));
    }
    return null;
}

async function press(x, y) {
    const place = { x: await evaluate(x), y: await evaluate(y), button: 'left', clickCount: 1 };
    await page('Input.dispatchMouseEvent', { type: 'mousePressed', ...place });
    await page('Input.dispatchMouseEvent', { type: 'mouseReleased', ...place });
}

let status = 0;
try {
    await page('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: width < 600 });
    for (const line of readFileSync(0, 'utf8').split('\n').filter(Boolean)) {
        const words = line.split(' ');
        if (words[0] === 'go') await page('Page.navigate', { url: words[1] });
        else if (words[0] === 'click') await press(words[1], words[2]);
        else console.log(JSON.stringify(await evaluate(line)));
    }
    if (screenshot !== undefined)
        writeFileSync(screenshot, Buffer.from((await page('Page.captureScreenshot', { format: 'png' })).data, 'base64'));
} catch (error) {
    console.error(error.message);
    status = 1;
}
await call('Browser.close').catch(() => undefined);
process.exitCode = status;
