// Prints what @mcap/core and the ROS 2 decoder of Foxglove read in an MCAP file, as JSON: bytes as base64.
const fs = require("fs");
const { McapIndexedReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

async function main(path) {
  const data = fs.readFileSync(path);
  const readable = { size: async () => BigInt(data.length),
    read: async (at, size) => new Uint8Array(data.subarray(Number(at), Number(at + size))) };
  const reader = await McapIndexedReader.Initialize({ readable });
  const readers = {}, topics = {};
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId), schema = reader.schemasById.get(channel.schemaId);
    readers[schema.name] ??= new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
    const topic = (topics[channel.topic] ??= { type: schema.name, messages: [] });
    topic.messages.push({ time_ns: Number(message.logTime), ...readers[schema.name].readMessage(message.data) });
  }
  console.log(JSON.stringify({ count: Number(reader.statistics.messageCount), topics }, (_, value) =>
    value instanceof Uint8Array ? Buffer.from(value).toString("base64") : ArrayBuffer.isView(value) ? Array.from(value) : value));
}

main(process.argv[2]);
