// A lesson in a worker of its page. In: one request after the other, each the arguments of a run (lesson_page.c), the first
// one also the program, compressed, in base64. Out: what it printed and the files it wrote. Invariant: each run is a new program in
// a memory of its own, so that addresses are the same in all of them; there are no files but those of the run.
import { FILE, FOLDER, fail, run } from './wasi.mjs';

/** One name a file: /./a is /a. */
const plain = path => '/' + path.split('/').filter(part => part !== '' && part !== '.').join('/');

/** A system that is nothing but files in memory: of each run its own. */
function make_system(files, print) {
    const find = path => files.get(plain(path)) ?? fail('ENOENT');
    return {
        terminal: () => false,
        folder: () => '/',
        now: of_day => BigInt(Math.round((of_day ? Date.now() : performance.now()) * 1e6)),
        random: to => void crypto.getRandomValues(to),
        sleep: () => undefined, // nobody else runs meanwhile
        input: () => 0,
        output: (stream, from) => print(new TextDecoder().decode(from)) ?? from.length,
        status(path) {
            if (plain(path) === '/') return { kind: FOLDER, size: 0, device: 1, number: 1, changed: 0 };
            const size = find(path).length;
            return { kind: FILE, size, device: 1, number: [...files.keys()].indexOf(plain(path)) + 2, changed: 0 };
        },
        read: path => find(path).slice(),
        write: (path, bytes, exclusive) => exclusive && files.has(plain(path)) ? fail('EEXIST')
            : void files.set(plain(path), bytes.slice()),
        link: () => fail('EINVAL'),
        rename(from, to) {
            files.set(plain(to), find(from));
            files.delete(plain(from));
        },
        remove: path => void (files.delete(plain(path)) || fail('ENOENT')),
        list: path => plain(path) === '/' ? [...files.keys()].map(name => ({ name: name.slice(1), kind: FILE })) : fail('ENOTDIR'),
        make_folder: () => fail('EPERM'),
        remove_folder: () => fail('EPERM'),
    };
}

async function unpack(base64) {
    const packed = new Blob([Uint8Array.from(atob(base64), letter => letter.charCodeAt(0))]);
    return new Response(packed.stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

let compiled;

self.onmessage = async ({ data: { program, number, words } }) => {
    compiled ??= unpack(program).then(WebAssembly.compile);
    const files = new Map();
    let text = '', status;
    try {
        status = run(await compiled, words, make_system(files, more => void (text += more)));
    } catch (error) {
        status = 2;
        text += error.stack;
    }
    self.postMessage({ number, status, text, files });
};
