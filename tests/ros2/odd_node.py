"""A planner that after two simulated seconds does something that a node in the lock-step must not do.

    odd_node.py thread|throw|service|late|stall
    odd_node.py nothing|hesitate   allowed behaviour: hesitate computes for a second of wall time
"""
import sys
import threading
import time

from rcl_interfaces.srv import GetParameters
from skein_ros import Planner, run
from std_msgs.msg import String


class Odd(Planner):
    def __init__(self):
        super().__init__("odd")
        if sys.argv[1] == "service":
            self.parameters = self.create_client(GetParameters, "/another/get_parameters")

    def plan(self, inputs):
        self.fly_to(inputs.p_WB + [0, 0, 1], 0.0)
        if inputs.time_s < 2.0:
            return
        if sys.argv[1] == "thread":
            thread = threading.Thread(target=lambda: self.say("from elsewhere"), name="elsewhere")
            thread.start()
            thread.join()
        elif sys.argv[1] == "throw":
            raise ValueError("no way ahead")
        elif sys.argv[1] == "service":
            self.parameters.call_async(GetParameters.Request())
        elif sys.argv[1] == "late":
            self.create_publisher(String, f"/{self.uav}/debug/late", 10)
        elif sys.argv[1] == "stall":
            while True:  # a sleep would take only simulated time
                pass
        elif sys.argv[1] == "hesitate" and inputs.time_s < 2.05:
            until = time.monotonic() + 1.0
            while time.monotonic() < until:
                pass


run(Odd)
