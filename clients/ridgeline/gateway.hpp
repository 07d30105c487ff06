#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "clients/ridgeline/session.hpp"

namespace httplib {
class Server;
struct Request;
struct Response;
}  // namespace httplib

namespace ridgeline::command {

/// HTTP on the loopback for a browser of this machine, DDS towards the service like any client.
/// Requests that come from another page or under another name of this machine are refused.
class Gateway {
public:
  explicit Gateway(const Session& session);
  ~Gateway();

  /// Takes the port, 0: any that is free. Throws Error{BadFile} when it is not to be had.
  int bind(int port);
  /// Answers until the session is interrupted.
  void run();

private:
  void set_up();
  /// How far a job is that this gateway has sent.
  struct UnderWay {
    double fraction = 0;
    std::string stage;
  };
  bool is_allowed(const httplib::Request& request) const;
  void status(httplib::Response& response);
  void library(httplib::Response& response) const;
  void job(const httplib::Request& request, httplib::Response& response);
  void result(const httplib::Request& request, httplib::Response& response);
  jobs::Answer compute(const std::string& text, const std::string& format);

  const Session& session_;
  std::unique_ptr<httplib::Server> server_;
  int port_ = 0;
  std::mutex mutex_;  ///< of the rest
  std::map<int, UnderWay> under_way_;
  std::deque<std::pair<std::string, std::string>> results_;  ///< path and page, the latest last
  int count_ = 0;
};

}  // namespace ridgeline::command
