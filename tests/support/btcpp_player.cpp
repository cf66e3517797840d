// Loads a tree into BehaviorTree.CPP and ticks it, with actions that play scripts: R, S or F for each
// tick, of which the last repeats. Prints what happens at each tick, and the state behind `=`.
//
// Arguments: the XML file, how many ticks, then for each action its name, its script and its ports,
// `wait=RS,Duration:double`.

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

#include "behaviortree_cpp/bt_factory.h"

namespace {

std::map<std::string, std::string> scripts;
std::string events;

class Player : public BT::StatefulActionNode {
 public:
  Player(const std::string& name, const BT::NodeConfig& config)
      : BT::StatefulActionNode(name, config) {}

  BT::NodeStatus onStart() override {
    at_ = 0;
    events += registrationName() + "^";
    return onRunning();
  }

  BT::NodeStatus onRunning() override {
    const std::string& script = scripts[registrationName()];
    const char state = script[std::min(at_++, script.size() - 1)];
    events += registrationName() + std::string(1, state);
    if (state == 'R') return BT::NodeStatus::RUNNING;
    return state == 'S' ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
  }

  void onHalted() override { events += registrationName() + "!"; }

 private:
  std::size_t at_ = 0;
};

BT::PortInfo port(const std::string& type) {
  const auto direction = BT::PortDirection::INPUT;
  if (type == "double") return BT::CreatePort<double>(direction, "port").second;
  if (type == "int") return BT::CreatePort<int>(direction, "port").second;
  if (type == "bool") return BT::CreatePort<bool>(direction, "port").second;
  return BT::CreatePort<std::string>(direction, "port").second;
}

void register_action(BT::BehaviorTreeFactory& factory, const std::string& argument) {
  std::istringstream parts(argument);
  std::string head, part;
  std::getline(parts, head, ',');
  const auto equals = head.find('=');
  const std::string name = head.substr(0, equals);
  scripts[name] = head.substr(equals + 1);
  BT::PortsList ports;
  while (std::getline(parts, part, ',')) {
    const auto colon = part.find(':');
    ports.insert({part.substr(0, colon), port(part.substr(colon + 1))});
  }
  BT::TreeNodeManifest manifest{BT::NodeType::ACTION, name, ports, {}};
  factory.registerBuilder(manifest, [](const std::string& label, const BT::NodeConfig& config) {
    return std::make_unique<Player>(label, config);
  });
}

}  // namespace

int main(int count, char** arguments) {
  std::ifstream file(arguments[1]);
  std::stringstream text;
  text << file.rdbuf();
  try {
    BT::BehaviorTreeFactory factory;
    for (int number = 3; number < count; ++number) register_action(factory, arguments[number]);
    auto tree = factory.createTreeFromText(text.str());
    for (int tick = 0; tick < std::stoi(arguments[2]); ++tick) {
      events.clear();
      const BT::NodeStatus state = tree.tickExactlyOnce();
      std::cout << events << "=" << BT::toStr(state)[0] << "\n";
      if (BT::isStatusCompleted(state)) break;
    }
  } catch (const std::exception& problem) {
    std::cout << "refused: " << problem.what() << "\n";
    return 1;
  }
}
