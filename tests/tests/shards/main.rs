//! `blysk shard`: the merged report is that of one machine, byte for byte, for any number of shards; a killed shard
//! goes on; and what does not belong together is refused.

mod campaign;
mod killed;
mod refused;
mod rtl;
mod same_bytes;
mod workflow;
