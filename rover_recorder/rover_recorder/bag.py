"""The folder of a recording as rosbag2 has it: one MCAP file, and metadata.yaml beside it.

The form is that of rosbag2 in Jazzy, version 9 of its metadata.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import yaml
from mcap.records import Channel, Schema

from rover_common.whole_file import write_whole
from rover_recorder.types import Topic

METADATA = "metadata.yaml"
PROFILE = "ros2"  # of the MCAP file
ENCODING = "cdr"  # of messages
SCHEMA_ENCODING = "ros2msg"
QOS_KEY = "offered_qos_profiles"  # in a channel's metadata
HASH_KEY = "topic_type_hash"
VERSION = 9


def file_of(folder: Path) -> Path:
    """The MCAP file of a new recording in this folder."""
    folder = folder.absolute()
    return folder / f"{folder.name}_0.mcap"


def channel_metadata(topic: Topic) -> dict[str, str]:
    """What a channel of the MCAP file says about its topic."""
    return {QOS_KEY: json.dumps(topic.qos), HASH_KEY: topic.type_hash}  # YAML holds JSON


def topic_of(channel: Channel, schema: Schema) -> Topic:
    """The topic of a channel; a recording of another recorder may lack its QoS and hash."""
    return Topic(
        name=channel.topic,
        type=schema.name,
        definition=schema.data.decode(),
        qos=tuple(yaml.safe_load(channel.metadata.get(QOS_KEY, "")) or ()),
        type_hash=channel.metadata.get(HASH_KEY, ""),
    )


def write_metadata(
    path: Path, topics: Mapping[str, Topic], counts: Mapping[str, int], start: int, end: int
) -> None:
    """Write metadata.yaml beside the MCAP file; start and end [ns] are log times.

    `counts` holds the number of messages by topic.
    """
    total = sum(counts.values())
    span = {
        "duration": {"nanoseconds": end - start},
        "starting_time": {"nanoseconds_since_epoch": start},
        "message_count": total,
    }
    information = {
        "version": VERSION,
        "storage_identifier": "mcap",
        **span,
        "topics_with_message_count": [
            {"topic_metadata": _topic_metadata(topic), "message_count": counts.get(name, 0)}
            for name, topic in topics.items()
        ],
        "compression_format": "",  # of whole files; the chunks of an MCAP file say their own
        "compression_mode": "",
        "relative_file_paths": [path.name],
        "files": [{"path": path.name, **span}],
        "custom_data": {},
        "ros_distro": "jazzy",
    }
    # yaml writes aliases for what occurs twice, which not every reader of metadata knows.
    dumper = type("Plain", (yaml.SafeDumper,), {"ignore_aliases": lambda *_: True})
    text = yaml.dump({"rosbag2_bagfile_information": information}, Dumper=dumper, sort_keys=False)
    write_whole(path.parent / METADATA, text)


def _topic_metadata(topic: Topic) -> dict[str, object]:
    return {
        "name": topic.name,
        "type": topic.type,
        "serialization_format": ENCODING,
        QOS_KEY: list(topic.qos),
        "type_description_hash": topic.type_hash,
    }
