"""Plays the messages that dump.mjs has read from a bag as ROS 2's player does: raw, by publishers with the offered QoS.

    play.py DUMP STAY HEARD  begins once every topic has a subscriber; publishes each message once the file HEARD has a
                             line for the one before, because one middleware acknowledges only after seconds; stays
                             until the file STAY exists
"""
import base64
import importlib
import json
import os
import sys
import time

import rclpy
import yaml
from rclpy.qos import QoSProfile

dump, stay, heard = sys.argv[1:]
with open(dump, encoding="utf-8") as lines:
    messages = [json.loads(line) for line in lines]
rclpy.init()
node = rclpy.create_node("play")
publishers = {}
for message in messages:
    assert message["encodings"] == ["ros2msg", "cdr"], message["encodings"]
    if message["topic"] in publishers:
        continue
    package, _, kind = message["type"].split("/")
    offered = yaml.safe_load(message["qos"])[0]
    qos = QoSProfile(history=offered["history"], depth=offered["depth"], reliability=offered["reliability"],
                     durability=offered["durability"])
    publishers[message["topic"]] = node.create_publisher(
        getattr(importlib.import_module(package + ".msg"), kind), message["topic"], qos)
while min(publisher.get_subscription_count() for publisher in publishers.values()) == 0:
    time.sleep(0.02)
with open(heard, encoding="utf-8") as lines:
    for message in messages:
        publishers[message["topic"]].publish(base64.b64decode(message["data"]))
        line = lines.readline()
        while not line.endswith("\n"):
            time.sleep(0.001)
            line += lines.readline()
open(stay + ".played", "w", encoding="utf-8").close()
while not os.path.exists(stay):
    time.sleep(0.02)
rclpy.shutdown()
