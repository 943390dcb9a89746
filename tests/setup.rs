//! Setups in TOML and JSON: what people write is read, what is wrong is said in one sentence, and what is written is read again.
