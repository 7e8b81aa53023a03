// Reads a recording with code that is not Skein's: with @mcap/core, by the index (complete files) or as a stream
// (truncated files). Decodes each message with the definition in the file. Prints one line of JSON.
//   node check.mjs FILE [stream]
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";
import { readFileSync } from "node:fs";
import { open } from "node:fs/promises";

const [, , file, mode] = process.argv;
const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };

const found = { messages: 0, topics: {}, types: {}, bytes: {}, first: null, last: null, ordered: true, metadata: {} };
const readers = new Map();
let before = -1n;

function take(message, channel, schema) {
  const topic = channel.topic;
  found.messages += 1;
  found.topics[topic] = (found.topics[topic] ?? 0) + 1;
  found.bytes[topic] = (found.bytes[topic] ?? 0) + message.data.length;
  found.types[topic] = schema?.name ?? "";
  if (message.logTime < before) found.ordered = false;
  before = message.logTime;
  found.first ??= Number(message.logTime) / 1e9;
  found.last = Number(message.logTime) / 1e9;
  if (!schema) return;
  if (!readers.has(schema.id)) {
    const text = new TextDecoder().decode(schema.data);
    readers.set(schema.id, new MessageReader(parse(text, { ros2: true })));
  }
  const decoded = readers.get(schema.id).readMessage(message.data);
  if (topic === "/skein/tally") found.tally = { points: decoded.points, score: decoded.score, earned: decoded.earned };
}

if (mode === "stream") {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(new Uint8Array(readFileSync(file)));
  const channels = new Map();
  const schemas = new Map();
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") {
      const channel = channels.get(record.channelId);
      take(record, channel, schemas.get(channel.schemaId));
    }
    if (record.type === "Metadata") found.metadata[record.name] = Object.fromEntries(record.metadata);
    if (record.type === "DataEnd") found.dataEnd = true;
  }
  found.complete = reader.done();
} else {
  const handle = await open(file, "r");
  const { size } = await handle.stat();
  const readable = {
    size: async () => BigInt(size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      await handle.read(buffer, 0, Number(length), Number(offset));
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    take(message, channel, reader.schemasById.get(channel.schemaId));
  }
  for await (const metadata of reader.readMetadata()) {
    found.metadata[metadata.name] = Object.fromEntries(metadata.metadata);
  }
  found.statistics = Number(reader.statistics.messageCount);
  found.chunks = reader.chunkIndexes.length;
  await handle.close();
}
console.log(JSON.stringify(found));
