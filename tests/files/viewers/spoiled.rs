//! A recording that newer viewers cannot show, to see that the test would find it.

use rerun::components::Scalar;
use rerun::external::re_log_encoding::{Decoder, Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::{AnyValues, RecordingStreamBuilder, StoreKind};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Copies a recording of a line, and gives a column of its patches a second type.
pub fn write(of: &Path, to: &Path) {
    let file = BufReader::new(File::open(of).unwrap());
    let messages: Vec<LogMsg> = Decoder::<LogMsg>::decode_eager(file).unwrap().map(Result::unwrap).collect();
    let store = messages.iter().map(LogMsg::store_id).find(|store| store.kind() == StoreKind::Recording).unwrap();
    let builder =
        RecordingStreamBuilder::new(store.application_id().clone()).recording_id(store.recording_id().clone());
    let (stream, second) = builder.send_properties(false).enabled(true).memory().unwrap();
    stream.log_static("second", &AnyValues::default().with_component::<Scalar>("patch_kappa_r", [1.0])).unwrap();
    let version = rerun::build_info().version;
    let mut encoder =
        Encoder::new_eager(version, EncodingOptions::PROTOBUF_COMPRESSED, File::create(to).unwrap()).unwrap();
    for message in messages.iter().chain(&second.take()) {
        encoder.append(message).unwrap();
    }
    encoder.finish().unwrap();
}
