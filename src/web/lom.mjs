// lom under node: node src/web/lom.mjs build/wasm/lom.wasm ARGUMENT... In: the program for WebAssembly and its arguments.
// Out: what the program prints, writes and ends with. Invariant: paths are those of the machine, from its current folder on.
import { randomFillSync } from 'node:crypto';
import * as fs from 'node:fs';
import { isatty } from 'node:tty';
import { FILE, FOLDER, LINK, TERMINAL, run } from './wasi.mjs';

const sleep = milliseconds => void Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, milliseconds);

/** A pipe that does not block is tried again until it takes or gives something. */
function again(call) {
    for (;;) {
        try {
            return call();
        } catch (error) {
            if (error.code !== 'EAGAIN') throw error;
            sleep(1);
        }
    }
}

const kind_of = status => status.isFile() ? FILE : status.isDirectory() ? FOLDER : status.isSymbolicLink() ? LINK
    : status.isCharacterDevice() ? TERMINAL : 0;

const system = {
    terminal: isatty,
    folder: process.cwd,
    now: of_day => of_day ? BigInt(Date.now()) * 1000000n : process.hrtime.bigint(),
    random: randomFillSync,
    sleep,
    input: to => again(() => fs.readSync(0, to)),
    output: (stream, from) => again(() => fs.writeSync(stream, from)),
    status(path, follow) {
        const status = (follow ? fs.statSync : fs.lstatSync)(path, { bigint: true });
        return { kind: kind_of(status), size: status.size, device: status.dev, number: status.ino, changed: status.mtimeNs };
    },
    read: path => fs.readFileSync(path),
    write: (path, bytes, exclusive) => fs.writeFileSync(path, bytes, { flag: exclusive ? 'wx' : 'w' }),
    link: path => fs.readlinkSync(path),
    // The program knows no permissions: what replaces a file gets those it had.
    rename(from, to) {
        if (fs.existsSync(to)) fs.chmodSync(from, fs.statSync(to).mode & 0o777);
        fs.renameSync(from, to);
    },
    remove: fs.unlinkSync,
    list: path => fs.readdirSync(path, { withFileTypes: true }).map(entry => ({ name: entry.name, kind: kind_of(entry) })),
    make_folder: path => fs.mkdirSync(path),
    remove_folder: path => fs.rmdirSync(path),
};

const [file, ...words] = process.argv.slice(2);
if (file === undefined) {
    console.error('usage: node lom.mjs lom.wasm [ARGUMENT]...');
    process.exit(2);
}
try {
    process.exitCode = run(new WebAssembly.Module(fs.readFileSync(file)), ['lom', ...words], system);
} catch (error) {
    console.error(`lom: ${file}: ${error.stack}`); // no such file, no WebAssembly, or a trap
    process.exitCode = 2;
}
