// Reads some topics of a recording with @mcap/core, ordered by time. Prints a line of JSON for each message, with the
// data that a player of bags reads from the file.
//   node dump.mjs FILE TOPIC...
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";
import { open } from "node:fs/promises";

const [, , file, ...topics] = process.argv;
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
const decompressHandlers = { zstd: (bytes, length) => decompress(bytes, new Uint8Array(Number(length))) };
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
if (reader.header.profile !== "ros2") throw new Error(`profile ${reader.header.profile}`);
for await (const message of reader.readMessages({ topics })) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  console.log(
    JSON.stringify({
      topic: channel.topic,
      type: schema.name,
      encodings: [schema.encoding, channel.messageEncoding],
      qos: channel.metadata.get("offered_qos_profiles"),
      time: String(message.logTime),
      data: Buffer.from(message.data).toString("base64"),
    }),
  );
}
await handle.close();
