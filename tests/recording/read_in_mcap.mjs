// SPDX-License-Identifier: Apache-2.0
// Reads a recording with the indexed reader of MCAP and the decoder of ROS messages, and compares
// what they find with what the recording says of itself: each channel, cycle by cycle.
//
// usage: node read_in_mcap.mjs NODE_MODULES FILE.mcap
//
// It needs npm packages in the folder NODE_MODULES: npm install @mcap/core @foxglove/rosmsg
// @foxglove/rosmsg-serialization fzstd. They are not in Debian, so this is by hand.
import { strict as assert } from "node:assert";
import { open } from "node:fs/promises";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [modules, file] = process.argv.slice(2);
if (!file) {
    console.error("usage: node read_in_mcap.mjs NODE_MODULES FILE.mcap");
    process.exit(2);
}
const require = createRequire(resolve(modules, "any.js"));
const { McapIndexedReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg-serialization");
const fzstd = require("fzstd");

/** Keys that each message of a JSON channel has: docs/recording.md. */
const keys = {
    "/rosters": ["number", "first"],
    "/events": ["cycle", "utc", "severity", "kind", "text"],
    "/commands": ["cycle", "utc"],
    "/leases": ["cycle", "utc", "what"],
    "/statistics": ["cycle", "utc", "counters"],
    "/gaps": ["first", "last", "cycles"],
    "/digest": ["next", "digest"],
};

async function read(name) {
    const handle = await open(name);
    const source = {
        size: async () => BigInt((await handle.stat()).size),
        read: async (offset, length) => {
            const bytes = new Uint8Array(Number(length));
            await handle.read(bytes, 0, Number(length), Number(offset));
            return bytes;
        },
    };
    return McapIndexedReader.Initialize({
        readable: source,
        decompressHandlers: { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) },
    });
}

/** The cycles of /plant: consecutive but for those that /gaps and `skipped` leave out. */
class Cycles {
    next = 0n;
    missing = 0n;
    rows = new Map();

    take(message, channel) {
        const cycle = message.cycle;
        assert.equal(BigInt(channel.sequence), cycle.number & 0xffffffffn);
        assert.equal(cycle.number - cycle.skipped, this.next, "a cycle is missing, and no gap says so");
        assert.ok(message.quality.every((quality) => quality <= 254));
        this.next = cycle.number + 1n;
        this.rows.set(Number(cycle.number), message);
    }

    takeGap(gap) {
        assert.equal(BigInt(gap.first), this.next);
        this.next = BigInt(gap.last) + 1n;
        this.missing += BigInt(gap.cycles);
    }
}

function checkJson(topic, message) {
    for (const key of message.lost === undefined ? keys[topic] : [])
        assert.ok(key in message, `a message of ${topic} has no '${key}': ${JSON.stringify(message)}`);
}

/** Whether the plant has the value that a command has set, in the cycle that adopted it. */
function checkCommands(commands, cycles, fields) {
    let adopted = 0;
    for (const command of commands) {
        const field = fields.get(command.signal);
        const row = cycles.rows.get(command.cycle);
        if (field === undefined || row === undefined || command.to === undefined || command.adopted === false) continue;
        if (command.how !== undefined && command.how !== "set") continue;
        assert.equal(Number(row[field]), Number(command.to), `${JSON.stringify(command)} is not what was adopted`);
        ++adopted;
    }
    return adopted;
}

/** Names of signals, which stand in the comments of the schema, and of their fields. */
function fieldsOf(schema) {
    const found = new Map();
    for (const line of schema.split("=".repeat(80))[0].split("\n")) {
        const match = /^[\w/]+(?:\[\d+\])? (\w+) {2}# (\S+)/.exec(line);
        if (match) found.set(match[2], match[1]);
    }
    return found;
}

async function main() {
    const reader = await read(file);
    const decoders = new Map();
    const counts = new Map();
    const cycles = new Cycles();
    const commands = [];
    let fields = new Map();
    let digest;
    let time = 0n;
    for await (const each of reader.readMessages()) {
        const channel = reader.channelsById.get(each.channelId);
        const topic = channel.topic;
        counts.set(topic, (counts.get(topic) ?? 0) + 1);
        assert.ok(each.logTime >= time, "messages go back in time");
        time = each.logTime;
        if (channel.messageEncoding === "json") {
            const message = JSON.parse(new TextDecoder().decode(each.data));
            checkJson(topic, message);
            if (topic === "/gaps") cycles.takeGap(message);
            if (topic === "/commands") commands.push(message);
            if (topic === "/digest") digest = message;
            continue;
        }
        assert.equal(channel.messageEncoding, "ros1");
        const schema = reader.schemasById.get(channel.schemaId);
        assert.equal(schema.encoding, "ros1msg");
        if (!decoders.has(channel.id)) {
            const text = new TextDecoder().decode(schema.data);
            decoders.set(channel.id, new MessageReader(parse(text)));
            if (topic === "/plant") fields = fieldsOf(text);
        }
        const message = decoders.get(channel.id).readMessage(each.data);
        if (topic === "/plant") cycles.take(message, each);
    }
    const stated = new Map([...reader.statistics.channelMessageCounts]);
    for (const channel of reader.channelsById.values())
        assert.equal(BigInt(counts.get(channel.topic) ?? 0), stated.get(channel.id) ?? 0n, channel.topic);
    assert.ok(cycles.rows.size > 0 && digest.end === true, "the end of the phase is missing");
    assert.equal(BigInt(digest.cycles) - BigInt(digest.missing), BigInt(cycles.rows.size));
    const adopted = checkCommands(commands, cycles, fields);
    const names = [];
    for await (const attachment of reader.readAttachments()) names.push(attachment.name);
    for (const name of ["recording.txt", "initial_values.json", "overview.bin"]) assert.ok(names.includes(name), name);
    const list = [...counts].map(([topic, count]) => `${topic} ${count}`).sort();
    console.log(`${cycles.rows.size} cycles, ${cycles.missing} missing, ${adopted} values were adopted as told`);
    console.log(list.join(", "));
}

await main();
