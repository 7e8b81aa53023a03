"""The inputs of one exchange for a member of the lock-step, with the types of `skein.planner`."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..errors import DamagedError, InputError
from ..planner import GimbalState, KeyFrame, OrientedBox, RadioMessage, Scan, State, TICKS_PER_SECOND
from . import messages, words
from .messages import Message
from .words import Neighbour

if TYPE_CHECKING:
    from .member import Client

_TEXT = "std_msgs/msg/String"


class Step:
    """The inputs of one exchange of 50 ms. You may keep it. It converts a field when you first read it."""

    def __init__(self, client: Client, k: int, tick: int, final: bool, arrived: dict[str, list[bytes]],
                 station_linked: bool, undelivered: int) -> None:
        self._client = client
        self._arrived = arrived
        self._latest = dict(client._latest)
        self.k = k          #: number of the exchange
        self.tick = tick    #: simulated time, in ticks of 2.5 ms
        self.final = final  #: whether it is the last one
        self.station_linked = station_linked  #: direct link to the station
        self.undelivered = undelivered        #: captures that the station has not acknowledged

    @property
    def time_s(self) -> float:
        """Simulated time [s]."""
        return self.tick / TICKS_PER_SECOND

    def messages(self, topic: str) -> list[Message]:
        """All messages that arrived with this step on a topic of `Client(read=...)` or a radio topic, in order. Raises
        DamagedError if a link with `corruption` has changed a message so that it is no message of its type."""
        of = self._client._type_of(topic)
        return [messages.decode(of, payload) for payload in self._payloads(topic)]

    def _payloads(self, topic: str) -> Sequence[bytes]:
        return self._arrived.get(self._client._arrival(topic), ())

    def _last(self, topic: str) -> Message | None:
        payload = self._latest.get(topic)
        return None if payload is None else messages.decode(self._client._type_of(topic), payload)

    @cached_property
    def state(self) -> State:
        """State of the own body, by its odometry. Raises InputError at the station, or before the first odometry."""
        odometry = self._last(f"/{self._client.name}/ground_truth/odometry")
        if odometry is None:
            raise InputError("the ground station has no body" if not self._client.is_uav else "no odometry yet")
        return words.state_of(odometry)

    @cached_property
    def gimbal(self) -> GimbalState | None:
        last = self._last(f"/{self._client.name}/gimbal")
        return None if last is None else words.gimbal_of(last)

    @cached_property
    def boxes(self) -> tuple[OrientedBox, ...]:
        """The boxes to inspect; empty until received."""
        last = self._last("/gcs/bounding_box_vertices")
        return () if last is None else words.boxes_of(last)

    @cached_property
    def mission_remaining_s(self) -> float | None:
        """Remaining mission time [s]; None before the first takeoff of the fleet."""
        last = self._last(f"/{self._client.name}/mission_duration_remained")
        return None if last is None else words.seconds_of(last)

    @cached_property
    def neighbours(self) -> tuple[Neighbour, ...]:
        """Nodes in line of sight at this step, including the station."""
        names = ("gcs", *(one.name for one in self._client.config.fleet))
        clouds = self.messages(f"/{self._client.name}/nbr_odom_cloud")
        return words.neighbours_of(clouds[-1], names) if clouds else ()

    @cached_property
    def detected(self) -> npt.NDArray[np.void]:
        """Interest points in this step's pictures: `p_W`, `n_W` (3 float32), `score`, `order`."""
        return words.detected_of(self.messages("/skein/detected") if self._client.is_uav else [])

    @cached_property
    def radio(self) -> tuple[RadioMessage, ...]:
        """Texts that other nodes sent, without damaged messages. For topics of other types:
        `messages("/their_topic")`."""
        found = []
        for topic in (topic for topic, of in self._client._radio.items() if of == _TEXT):
            for payload in self._payloads(topic):
                with contextlib.suppress(DamagedError):  # links with corruption: as if it were lost
                    found.append(RadioMessage(topic, messages.decode(_TEXT, payload).data))
        return tuple(found)

    @cached_property
    def scans(self) -> tuple[Scan, ...]:
        """Scans of the own LiDAR; only with `Client(scans=True)`."""
        return tuple(Scan(words.tick_of(one.header), words.cloud_points(one))
                     for one in self._optional("cloud_inW", "scans"))

    @cached_property
    def key_frames(self) -> tuple[KeyFrame, ...]:
        """Key frames, own ones first, then those of neighbours; only with `Client(key_frames=True)`."""
        own = self._client.config.index + 1
        found = [KeyFrame(words.cloud_points(one), None, own) for one in self._optional("slf_kf_cloud", "key_frames")]
        return tuple(found + [KeyFrame(words.cloud_points(one), None, words.source_of(one))
                              for one in self._optional("nbr_kf_cloud", "key_frames")])

    @cached_property
    def rejected(self) -> tuple[str, ...]:
        """Why the server ignored commands of the last step."""
        if not self._client.is_uav:
            return ()
        return tuple(f"{one.command}: {one.reason}"
                     for one in self.messages(f"/{self._client.name}/command_rejected"))

    def _optional(self, topic: str, option: str) -> list[Message]:
        if option not in self._client._options:
            raise InputError(f"{option} are not read: Client({option}=True) does")
        name = f"/{self._client.name}/{topic}"
        return self.messages(name) if name in self._client._read else []
