// Planners in Python, called with inputs that the tests make: conversion of inputs and outputs, and errors.
#include "uav_agent/python/python_planner.hpp"

#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/testing/python_planner_fixture.hpp"

namespace skein::agent {
namespace {

TEST_F(PythonPlannerTest, InputsArriveAsTheyAre) {
  const auto planner = planning(
      "assert (inputs.k, inputs.tick, inputs.time_s) == (7, 140, 0.35)\n"
      "        assert inputs.state.p_WB.tolist() == [1, 2, 3] and inputs.state.v_WB.tolist() == [0.5, 0.25, 0.125]\n"
      "        assert inputs.state.q_WB.tolist() == [1, 0, 0, 0] and inputs.state.R_WB.tolist() == np.eye(3).tolist()\n"
      "        assert inputs.boxes[0].name == 'box' and inputs.boxes[0].contains([1, 2, 5.9])\n"
      "        assert [peer.name for peer in inputs.peers] == ['raffles', 'sentosa'] and inputs.peers[0].seen is None\n"
      "        assert inputs.mission_remaining_s == 12.5 and inputs.space is None\n"
      "        assert inputs.scans[0].points_W.dtype == np.float32\n"
      "        assert inputs.scans[0].points_W.tolist() == [[1, 2, 3], [4, 5, 6]]\n"
      "        assert inputs.detected['p_W'].tolist() == [[1, 2, 3], [4, 5, 6]]\n"
      "        assert inputs.detected['n_W'].tolist() == [[0, 0, 1], [1, 0, 0]]\n"
      "        assert inputs.detected['order'].tolist() == [9, 8] and inputs.detected['score'][1] == 0.25\n"
      "        assert self.agent.name == 'jurong' and self.agent.me().role == 'explorer'\n"
      "        assert inputs.radio == () and inputs.flight.goal is None and inputs.tracking.done");
  EXPECT_EQ(refusal(*planner), "");
}

TEST_F(PythonPlannerTest, PeersHaveTheDeviationOfTheirPositions) {
  agent_.odometry = {.horizontal_sigma_m = 3.0, .vertical_sigma_m = 2.0, .bias_sigma_m = 4.0, .known_start = true};
  seen_ = {{{.node = Node{2}, .p_W = {8.0, 0.0, 5.0}, .v_W = Vector3d(1.0, 0.0, 0.0)}}};
  const auto planner = planning(
      "left, stands = inputs.peers\n"
      "        assert (left.name, left.left_start, stands.left_start) == ('raffles', True, False)\n"
      "        assert left.visible and not stands.visible and left.deviation_m.tolist() == [5, 5, 20 ** 0.5]\n"
      "        assert all(4 <= of_one < 4.1 for of_one in stands.deviation_m), stands.deviation_m");
  EXPECT_EQ(refusal(*planner), "");
  agent_.odometry = {};
  const auto exact = planning("assert not any(peer.left_start or peer.deviation_m.any() for peer in inputs.peers)");
  EXPECT_EQ(refusal(*exact), "");
}

TEST_F(PythonPlannerTest, LinksHaveTheirQuality) {
  seen_ = {{{.node = Node{2}}, {.node = kStationNode}}};
  links_ = {{Node{2}, {-61.5, 1e6}}, {kStationNode, {-80.0, 125e3}}};
  const auto planner = planning(
      "near, far = inputs.peers\n"
      "        assert (near.link.received_dbm, near.link.rate_bit_s) == (-61.5, 1e6)\n"
      "        assert far.link is None and inputs.station_link.rate_bit_s == 125e3");
  EXPECT_EQ(refusal(*planner), "");
  links_ = {};
  EXPECT_EQ(refusal(*planning("assert inputs.peers[0].link is None and inputs.station_link is None")), "");
}

TEST_F(PythonPlannerTest, MapsAnswerForOnePlaceAndForManyAtOnce) {
  map_.insert({{5.1F, 5.1F, 5.1F}, {9.1F, 5.1F, 5.1F}}, std::nullopt);
  world_.set_free({0.25, 0.25, 0.25}, 0.1);
  const auto planner = planning(
      "m, w, p = inputs.map, inputs.world_map, np.array([[5.1, 5.1, 5.1], [0, 0, 0], [9.1, 5.1, 5.1]])\n"
      "        assert m.occupied(p).tolist() == [True, False, True] and m.occupied(p[0]) is True\n"
      "        assert m.occupied_cells == 2 and not m.segment_clear(p[0], p[2], 0.5)\n"
      "        assert np.isinf(m.distance_to_occupied([0, 0, 0], 2.0)) and m.cast(p[1], [0, 0, -3], 10, 1) is None\n"
      "        assert len(m.occupied_in(OrientedBox('', p[0], np.ones(3), np.eye(3)))) == 1\n"
      "        assert w.at([0.25, 0.25, 0.25]) == Space.free and w.at(p).tolist() == [0, 1, 0]\n"
      "        assert w.window([0, 0, 0], [2, 3, 4]).shape == (2, 3, 4) and w.window([0, 0, 0], (1, 1, 1))[0, 0, 0] == "
      "1\n"
      "        assert w.regions().tolist() == [[0, 0, 0]] and not w.ball_free([0, 0, 0], 1.0, 0.0)");
  EXPECT_EQ(refusal(*planner), "");
  // Each of these invalid calls raises an exception.
  for (const char* question : {"m.occupied([1, 2])",
                               "m.occupied('abc')",
                               "m.occupied([1, 2, float('nan')])",
                               "m.occupied([1e9, 0, 0])",
                               "m.occupied(np.zeros((2, 2)))",
                               "m.occupied(np.zeros(3, complex))",
                               "m.known_free([0, 0, 0], 0)",
                               "m.distance_to_occupied([0, 0, 0], 1e9)",
                               "m.cast([0, 0, 0], [0, 0, 0], 5, 1)",
                               "m.cast([0, 0, 0], [1, 0, 0], float('nan'), 1)",
                               "m.segment_clear([0, 0, 0], [99999, 99999, 0], 1)",
                               "w.window([0, 0, 0], [0, 1, 1])",
                               "w.window([0, 0, 0], [10**9, 10**9, 10**9])",
                               "w.window([0, 0, 0], [1, 1])",
                               "w.at(None)",
                               "w.tube_free([0, 0, 0], [1, 0, 0], -1)",
                               "w.ball_free([0, 0, 0], 1, float('inf'))",
                               "m.occupied_in(3)",
                               "m.occupied_in(OrientedBox('', [1, 2], np.ones(3), np.eye(3)))",
                               "m.nothing",
                               "inputs.nothing"}) {
    const auto wrong = planning(std::string("m, w = inputs.map, inputs.world_map; ") + question);
    expect_has(refusal(*wrong), {"Traceback", question, "jurong's planner", "at step 7 (0.35 s)"});
  }
}

TEST_F(PythonPlannerTest, OutputsArriveAsTheyAre) {
  const auto planner = planning(
      "return PlannerOutput(motion=Path([Waypoint((1, 2, 3), 2), Waypoint(np.array([4, 5, 6]))]), yaw=0.5,\n"
      "            gimbal=[7, 8, 9], trigger=True, radio=[RadioMessage('/talk', 'h\\u00e4llo\\udcff')],\n"
      "            heard_maps=[b'\\0x'], going_to_W=(1, 1, 1), no_way='none', waits_for='sentosa', debug={'a': 1})",
      "    def debug_names(self): return ['a']\n");
  EXPECT_EQ(planner->debug_names(), std::vector<std::string>{"a"});
  const PlannerOutput out = ask(*planner);
  const auto& path = std::get<Path>(out.motion);
  ASSERT_EQ(path.waypoints.size(), 2U);
  EXPECT_EQ(path.waypoints[0].p_WB, Vector3d(1, 2, 3));
  EXPECT_EQ(path.waypoints[0].speed_mps, 2.0);
  EXPECT_EQ(path.waypoints[1].speed_mps, 1.0);
  EXPECT_EQ(std::get<Vector3d>(out.gimbal), Vector3d(7, 8, 9));
  EXPECT_TRUE(out.trigger);
  EXPECT_EQ(out.radio.at(0).text, "h\xc3\xa4llo\xff");
  EXPECT_EQ(out.heard_maps.at(0), std::string("\0x", 2));
  EXPECT_EQ(out.going_to_W, Vector3d(1, 1, 1));
  EXPECT_EQ(out.no_way, "none");
  EXPECT_EQ(out.waits_for, 2U);
  EXPECT_EQ(out.debug.at(0).value, 1.0);
  EXPECT_TRUE(std::holds_alternative<Hold>(ask(*planning("return PlannerOutput(motion=Hold())")).motion));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(ask(*planning("return None")).motion));
  const auto command = ask(*planning("return PlannerOutput(TrajectoryCommand(v_WB=(1, 0, 0), yaw_rate=2))"));
  EXPECT_EQ(std::get<TrajectoryCommand>(command.motion).v_WB, Vector3d(1, 0, 0));
}

/// Arrays from files and from the network often have the byte order of another machine, or begin at any byte.
TEST_F(PythonPlannerTest, VectorsArriveFromArraysOfAnyKindOfNumbers) {
  for (const char* array : {"np.array([1, 2, 3], '>f8')", "np.array([1, 2, 3], '<f8')", "np.array([1, 2, 3], '>f4')",
                            "np.array([1, 2, 3], '>i4')", "np.array([1, 2, 3], '>u2')", "np.array([3.0, 2, 1])[::-1]",
                            "np.frombuffer(b'?' + np.array([1.0, 2, 3]).tobytes(), '=f8', 3, 1)",
                            "np.array([(0, 1), (0, 2), (0, 3)], [('a', 'u1'), ('b', '>f8')])['b']"}) {
    const PlannerOutput out = ask(*planning(std::string("return PlannerOutput(motion=Setpoint(") + array + "))"));
    EXPECT_EQ(std::get<Setpoint>(out.motion).p_WB, Vector3d(1, 2, 3)) << array;
  }
}

/// Maps accept the same arrays of places.
TEST_F(PythonPlannerTest, MapsAcceptArraysOfAnyByteOrder) {
  const auto planner = planning(
      "places = np.array([[5.1, 5.1, 5.1], [0, 0, 0]])\n"
      "        for order in ('>f8', '>f4', '<f8'):\n"
      "            there = inputs.map.occupied(places.astype(order))\n"
      "            assert there.tolist() == inputs.map.occupied(places).tolist(), order\n"
      "            way = inputs.map.segment_clear(places[0].astype(order), places[1].astype(order), 0.5)\n"
      "            assert way == inputs.map.segment_clear(places[0], places[1], 0.5), order");
  EXPECT_EQ(refusal(*planner), "");
}

TEST_F(PythonPlannerTest, GoalsNeedTheFlightCore) {
  const std::string goal =
      "return PlannerOutput(goals=[Goal(3, [Waypoint([1, 2, 3])], yaw=1, gimbal=GimbalCommand('rate', 1, 2))])";
  const auto planner = planning(goal, "    def flight(self): return FlightConfig(climb_mps=2.5)\n");
  ASSERT_NE(planner->flight(), nullptr);
  EXPECT_EQ(planner->flight()->climb_mps, 2.5);
  const PlannerOutput out = ask(*planner);
  EXPECT_EQ(out.goals.value().at(0).id, 3);
  EXPECT_EQ(std::get<GimbalCommand>(out.goals->at(0).gimbal).mode, GimbalMode::rate);
  expect_has(refusal(*planning(goal)), {"goals", "flight()"});
}

TEST_F(PythonPlannerTest, AStakeNeedsTheFlightCoreAndNumbersOfAtLeastZero) {
  const std::string core = "    def flight(self): return FlightConfig(hazard_per_h=2)\n";
  const auto stating = [&](const std::string& stake, const std::string& flight) {
    return planning("return PlannerOutput(stake=" + stake + ")", flight);
  };
  const auto planner = stating("Stake(12.5, gain_per_s=2)", core);
  EXPECT_EQ(planner->flight()->hazard_per_h, 2.0);
  const PlannerOutput out = ask(*planner);
  EXPECT_EQ(out.stake.value().value, 12.5);
  EXPECT_EQ(out.stake->gain_per_s, 2.0);
  EXPECT_FALSE(ask(*stating("None", core)).stake);
  expect_has(refusal(*stating("Stake(12.5, 2)", "")), {"stake", "flight()"});
  expect_has(refusal(*stating("Stake(-1, 2)", core)), {"stake.value", "0 or more"});
  expect_has(refusal(*stating("Stake(1, float('nan'))", core)), {"stake.gain_per_s", "finite"});
  expect_has(refusal(*stating("3", core)), {"stake", "skein.planner.Stake"});
}

/// Each field gets each of many values, most of them wrong. The error of a wrong value names the field, and the planner
/// can be called again afterwards.
TEST_F(PythonPlannerTest, WrongOutputsAreRefusedByName) {
  const std::string bad =
      "class Odd:\n"
      "    def __float__(self): raise ValueError('odd')\n"
      "    def __repr__(self): raise ValueError('odd')\n"
      "    def __index__(self): return 2 ** 80\n"
      "n = float('nan')\n"
      "VALUES = [n, float('inf'), -float('inf'), 'text', b'bytes', 2 ** 80, -1, 3.5, [], [1, 2], [1, 2, 3, 4],\n"
      "    [n, 0, 0], [0, 0, float('inf')], ['a', 'b', 'c'], np.zeros((2, 3)), np.full(3, n), np.zeros(3, complex),\n"
      "    np.array(['a', 'b', 'c']), np.zeros(0), object(), Odd(), [Odd()] * 3, {}, {'b': 1}, {'a': n}, {1: 1}, "
      "[None],\n"
      "    [[]], (3,), True, 'nobody', 'jurong', 99, Path([]), Path(None), Path([1]), Path([Waypoint([0, 0, n])]),\n"
      "    Path([Waypoint([0, 0, 1], 0)]), Path([Waypoint([0, 0, 1], 'fast')]), Path, Setpoint([1, 2]),\n"
      "    Setpoint([1, 2, 3], n), Setpoint([1, 2, 3], a_WB='up'), TrajectoryCommand(yaw=n), GimbalCommand('spin'),\n"
      "    GimbalCommand('rate', n), [Goal(1, [])], [Goal('a', [Waypoint([0, 0, 1])])], [RadioMessage('/nobody', "
      "'x')],\n"
      "    [RadioMessage('/plan', 'a\\0b')], [RadioMessage('/plan', 3)], [RadioMessage(3, 'x')], ['x'], lambda: 1]\n"
      "FIELDS = ['motion', 'yaw', 'gimbal', 'trigger', 'radio', 'goals', 'heard_maps', 'going_to_W', 'no_way',\n"
      "    'waits_for', 'stake', 'debug']\n"
      "OUTPUTS = [lambda f=f, v=v: PlannerOutput(**{f: v}) for f in FIELDS for v in VALUES]\n"
      "OUTPUTS += [lambda v=v: v for v in VALUES]\n";
  const auto all = make(file(bad + "class Mine(Planner):\n"
                                   "    def debug_names(self): return ['a']\n"
                                   "    def plan(self, inputs):\n"
                                   "        return OUTPUTS[inputs.k]()\n"));
  const std::vector<std::string> fields = {"motion", "yaw",        "gimbal",     "trigger", "radio",
                                           "goals",  "heard_maps", "going_to_W", "no_way",  "waits_for",
                                           "stake",  "debug",      "plan()"};
  constexpr std::size_t kValues = 54, kAlways = 3;  // no field accepts a number that is not finite
  std::size_t refused = 0;
  for (std::size_t i = 0; i < fields.size() * kValues; ++i) {
    const std::string text = refusal(*all, i);
    const bool is_right = text.empty();
    EXPECT_FALSE(is_right && i % kValues < kAlways) << fields[i / kValues] << ", value " << i % kValues;
    if (is_right) continue;
    ++refused;
    EXPECT_EQ(text.find("jurong's planner"), 0U) << text;
    expect_has(text, {"was refused: " + fields[i / kValues], "at step " + std::to_string(i) + " ("});
  }
  EXPECT_GT(refused, fields.size() * kValues - 40) << "only few fields accept one of the values";
  EXPECT_LT(refused, fields.size() * kValues);
  EXPECT_NE(refusal(*all, fields.size() * kValues), "") << "there is no such output: all values were asked for";
}

TEST_F(PythonPlannerTest, AnExceptionNamesUavAndStepBelowItsTraceback) {
  const auto planner =
      planning("return self.deep(inputs)",
               "    def deep(self, inputs):\n        raise RuntimeError('too deep at %d' % inputs.k)\n");
  const std::string text = refusal(*planner, 120);
  expect_has(text, {"Traceback", "mine.py", "in deep", "RuntimeError: too deep at 120"});
  EXPECT_TRUE(text.ends_with("mine.py failed, at step 120 (6.00 s)")) << text;
  EXPECT_EQ(text.find("_embedded"), std::string::npos) << "the traceback does not show Skein's own frames";
  expect_has(refusal(*planning("import sys; sys.exit(3)")), {"SystemExit: 3"});
  expect_has(refusal(*planning("import os; os.fork()")), {"fork"});
  expect_has(refusal(*planning("breakpoint()")), {"--debug UAV=pdb"});
  expect_has(refusal(*planning("return self.plan(inputs)")), {"RecursionError"});
}

TEST_F(PythonPlannerTest, AnInputThatIsUsedAfterPlanReturnedRaisesGoneError) {
  const std::string keep = "        self.kept = inputs\n        return PlannerOutput()\n";
  const auto late =
      make(file("class Mine(Planner):\n    kept = None\n    def plan(self, inputs):\n"
                "        if self.kept is not None:\n            return self.kept.gimbal\n" +
                keep));
  EXPECT_EQ(refusal(*late), "");
  expect_has(refusal(*late), {"GoneError", "inputs.gimbal: plan() has returned"});
  const auto map =
      make(file("class Mine(Planner):\n    kept = None\n    def plan(self, inputs):\n"
                "        if self.kept is not None:\n            self.kept.occupied([0, 0, 0])\n"
                "        self.kept = inputs.map\n"));
  EXPECT_EQ(refusal(*map), "");
  expect_has(refusal(*map), {"GoneError", "inputs.map"});
}

TEST_F(PythonPlannerTest, ViewsOfCloudsAreReadOnlyAndMayNotBeKept) {
  for (const char* kept : {"inputs.scans[0].points_W", "inputs.scans[0].points_W[:1]", "inputs.scans",
                           "memoryview(inputs.scans[0].points_W)", "inputs.scans[0].points_W.T"}) {
    expect_has(refusal(*planning(std::string("self.kept = ") + kept)), {"inputs.scans[0].points_W was kept"});
  }
  expect_has(refusal(*planning("self.kept = inputs.detected['score']")), {"inputs.detected was kept"});
  for (const char* fine : {"self.kept = inputs.scans[0].points_W.copy()", "self.kept = inputs.scans[0].points_W + 1",
                           "self.kept = inputs.state.p_WB", "ring = [inputs.scans]; ring.append(ring)"}) {
    EXPECT_EQ(refusal(*planning(fine)), "") << fine;
  }
  expect_has(refusal(*planning("inputs.scans[0].points_W[0] = 0")), {"read-only"});
  expect_has(refusal(*planning("inputs.scans[0].points_W.flags.writeable = True")), {"WRITEABLE"});
}

TEST_F(PythonPlannerTest, ParametersAreReadAsThoseOfAnyPlanner) {
  const std::string spec = file(
      "class Mine(Planner):\n    @dataclass\n    class Config:\n        a: float = parameter(1.0, at_least=0, "
      "at_most=9)\n"
      "        n: int = 2\n        s: str = 'x'\n        b: bool = False\n        l: list[float] = "
      "field(default_factory=list)\n"
      "        o: float | None = None\n        flight: FlightConfig = field(default_factory=FlightConfig)\n"
      "    def plan(self, inputs):\n        c = self.config\n"
      "        raise RuntimeError(f'{c.a} {c.n} {c.s} {c.b} {c.l} {c.o} {c.flight.climb_mps} {c.flight.floor_m}')\n");
  expect_has(refusal(*make(spec)), {"1.0 2 x False [] None 3.0 2.0"});
  expect_has(refusal(*make(spec + ":a=4,n=5,s=y,b=true,o=7,climb_mps=2")), {"4.0 5 y True [] 7.0 2.0 2.0"});
  std::ofstream(folder_ / "p.yaml") << "a: 3\nl: [1, 2]\n";
  expect_has(refusal(*make(spec + ":" + (folder_ / "p.yaml").string())), {"3.0 2 x False [1.0, 2.0] None"});
  expect_has(input_error(spec + ":a=10"), {"a", "within [0, 9]"});
  expect_has(input_error(spec + ":n=1.5"), {"n"});
  expect_has(input_error(spec + ":climb_mp=1"), {"climb_mp", "climb_mps"});
  expect_has(input_error(spec + ":climb_mps=99"), {"climb_mps", "within [0.2, 10]"});
}

TEST_F(PythonPlannerTest, APlannerThatCannotBeLoadedIsBadInput) {
  const auto error = [&](const std::string& code, const std::string& more = "") {
    return input_error(file(code) + more);
  };
  const std::string good = "class Mine(Planner):\n    def plan(self, inputs): return None\n";
  EXPECT_EQ(error(good), "");
  expect_has(input_error("py:/nobody/there.py"), {"/nobody/there.py", "No such file"});
  expect_has(error("def plan(:\n"), {"SyntaxError", "mine.py", "line 4"});
  expect_has(error("import nothing_of_that_name\n"), {"ModuleNotFoundError", "nothing_of_that_name"});
  expect_has(error(""), {"there is no planner in it"});
  expect_has(error(good + "class Other(Mine): pass\n"), {"which of its planners", "Mine, Other"});
  expect_has(error(good, ":Min"), {"did you mean 'Mine'"});
  expect_has(error(good, ":np"), {"np is not a planner"});
  expect_has(error("class Mine(Planner):\n    Config = 3\n"), {"must be a dataclass"});
  expect_has(error("class Mine(Planner):\n    @dataclass\n    class Config:\n        a: dict = None\n"), {"Config.a"});
  expect_has(error("class Mine(Planner):\n    @dataclass\n    class Config:\n        a: int\n"), {"'a'", "required"});
  expect_has(error("class Mine(Planner):\n    def __init__(self): raise OSError('no')\n"), {"OSError: no", "mine.py"});
  expect_has(error("class Mine(Planner):\n    def __init__(self, a, b, c): pass\n"), {"takes 3"});
  expect_has(error(good + "    def wants_scans(self): return 'yes'\n"), {"wants_scans", "True or False"});
  expect_has(error(good + "    def flight(self): return 3\n"), {"flight()", "FlightConfig"});
  expect_has(error(good + "    def flight(self): return FlightConfig(floor_m=0)\n"), {"flight().floor_m", "within"});
  expect_has(error(good + "    def debug_names(self): return 'abc'\n"), {"debug_names()"});
}

/// Two UAVs in one process, called in turns, draw the same numbers as each UAV alone.
TEST_F(PythonPlannerTest, GeneratorsAndModulesAreEachUavsOwn) {
  std::ofstream(folder_ / "shared.py") << "count = 0\n";
  const std::string spec = file(
      "import random, shared\nclass Mine(Planner):\n    def plan(self, inputs):\n        import shared as again\n"
      "        assert again is shared\n        shared.count += 1\n"
      "        drawn = random.random(), random.gauss(0, 1), np.random.rand(), np.random.normal()\n"
      "        return PlannerOutput(no_way=' '.join(map(str, drawn)), yaw=float(shared.count))\n");
  const auto said = [&](Planner& planner) {
    const PlannerOutput out = ask(planner);
    return out.no_way + ", call " + std::to_string(out.yaw.value());
  };
  std::vector<std::vector<std::string>> alone(2), together(2);
  for (std::size_t uav : {0, 1}) {
    const auto planner = make(spec, 5, uav);
    for (int i = 0; i < 5; ++i) alone[uav].push_back(said(*planner));
  }
  const auto first = make(spec, 5, 0), second = make(spec, 5, 1);
  for (int i = 0; i < 5; ++i) {
    together[0].push_back(said(*first));
    together[1].push_back(said(*second));
  }
  EXPECT_EQ(together, alone);
  EXPECT_NE(alone[0], alone[1]);
  EXPECT_NE(said(*make(spec, 6, 0)), alone[0][0]) << "another seed gives other numbers";
  EXPECT_EQ(said(*make(spec, 5, 0)), alone[0][0]) << "a restarted planner draws the same numbers again";

  const auto stays = make(spec, 5, 0);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(said(*stays), alone[0][i]);
  said(*make(spec, 5, 1));  // it is destroyed while NumPy's generator has a Gaussian number in store
  EXPECT_EQ(said(*stays), alone[0][2]);
}

TEST_F(PythonPlannerTest, TheFlightConfigOfPythonIsThatOfCpp) {
  const auto planner = planning("return None", "    def flight(self): return FlightConfig()\n");
  struct Values {
    std::vector<double> all;
    void field(const char*, double& value, const Bounds&) { all.push_back(value); }
    void field(const char*, bool& value) { all.push_back(value ? 1.0 : 0.0); }
  } ours, theirs;
  FlightConfig usual;
  usual.describe(ours);
  FlightConfig given = *planner->flight();
  given.describe(theirs);
  EXPECT_EQ(theirs.all, ours.all);
  expect_has(refusal(*planning("import dataclasses; raise RuntimeError(len(dataclasses.fields(FlightConfig)))")),
             {"RuntimeError: " + std::to_string(ours.all.size())});
}

}  // namespace
}  // namespace skein::agent
