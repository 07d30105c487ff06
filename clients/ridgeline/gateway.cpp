#include "clients/ridgeline/gateway.hpp"

#include <httplib.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <stop_token>

#include "clients/client.hpp"
#include "clients/ridgeline/serve_page.hpp"
#include "jobs/parse.hpp"

namespace ridgeline::command {
namespace {

using httplib::Request;
using httplib::Response;
using Json = nlohmann::json;

constexpr const char* address = "127.0.0.1";
constexpr std::size_t kept_results = 16;

void send(Response& response, std::string_view text, const char* type) {
  response.set_content(text.data(), text.size(), type);
}

void send(Response& response, const Json& document) {
  send(response, document.dump(1, ' ', false, Json::error_handler_t::replace), "application/json");
}

/// HTTP's word for a refusal.
int http_status(const Json& document) {
  const std::string code = document.at("error").at("code").get<std::string>();
  if (code == name(ErrorCode::NoService) || code == name(ErrorCode::Busy)) return 503;
  if (code == name(ErrorCode::Timeout)) return 504;
  return 422;
}

void send_refusal(Response& response, const Json& document) {
  send(response, document);
  response.status = http_status(document);
}

Json refusal_of(const std::string& message) {
  return jobs::refusal(Error(ErrorCode::BadInput, message)).document;
}

const char* type_of(const std::string& format) {
  if (format == "json") return "application/json";
  return format == "svg" ? "image/svg+xml" : "text/plain; charset=utf-8";
}

}  // namespace

bool Gateway::is_allowed(const Request& request) const {
  const std::string port = ":" + std::to_string(port_);
  const std::string host = request.get_header_value("Host");
  if (host != "127.0.0.1" + port && host != "localhost" + port) return false;
  if (request.has_header("Origin") && request.get_header_value("Origin") != "http://" + host) {
    return false;
  }
  // A page elsewhere can send a form without asking first, but not JSON.
  return request.method != "POST" ||
         request.get_header_value("Content-Type").starts_with("application/json");
}

void Gateway::status(Response& response) {
  Json document = {{"status", "ok"}, {"instances", Json::array()}, {"under_way", Json::array()}};
  try {
    for (const wire::InstanceStatus& each : session_.status()) {
      document["instances"].push_back(wire::document(each));
    }
  } catch (const Error& error) {
    return send_refusal(response, jobs::refusal(error).document);
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [id, job] : under_way_) {
    document["under_way"].push_back({{"fraction", job.fraction}, {"stage", job.stage}});
  }
  send(response, document);
}

void Gateway::library(Response& response) const {
  const jobs::Answer answer = session_.ask(R"({"job": "library", "operation": "list"})", "json",
                                           [](double, std::string_view) {});
  if (jobs::is_error(answer)) return send_refusal(response, answer.document);
  send(response, answer.document);
}

jobs::Answer Gateway::compute(const std::string& text, const std::string& format) {
  std::unique_lock lock(mutex_);
  const int id = ++count_;
  under_way_[id];
  lock.unlock();
  jobs::Answer answer = session_.ask(text, format, [&](double fraction, std::string_view stage) {
    const std::lock_guard told(mutex_);
    under_way_[id] = {fraction, std::string(stage)};
  });
  lock.lock();
  under_way_.erase(id);
  return answer;
}

void Gateway::job(const Request& request, Response& response) {
  const std::string format =
      request.has_param("format") ? request.get_param_value("format") : "json";
  const jobs::Answer answer = compute(request.body, format);
  if (jobs::is_error(answer)) return send_refusal(response, answer.document);
  if (format == "json") return send(response, jobs::to_json(answer), "application/json");
  if (format != "html") return send(response, answer.text, type_of(format));
  const std::lock_guard lock(mutex_);
  const std::string path = "/result/" + std::to_string(++count_);
  results_.emplace_back(path, answer.text);
  if (results_.size() > kept_results) results_.pop_front();
  send(response, Json{{"result", path}});
  response.status = 201;
}

void Gateway::result(const Request& request, Response& response) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find_if(results_, [&](const auto& each) { return each.first == request.path; });
  if (found == results_.end()) {
    send(response, refusal_of("this result is not kept any more: compute it again"));
    response.status = 404;
    return;
  }
  // The page is one file with its scripts in it; it may do nothing but run them.
  response.set_header("Content-Security-Policy",
                      "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                      "img-src data: blob:; sandbox allow-scripts");
  send(response, found->second, "text/html; charset=utf-8");
}

Gateway::Gateway(const Session& session)
    : session_(session), server_(std::make_unique<httplib::Server>()) {}

Gateway::~Gateway() = default;

int Gateway::bind(int port) {
  // The library's usual SO_REUSEPORT would let two gateways share a port.
  server_->set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  port_ = port;
  const bool is_bound = port == 0 ? (port_ = server_->bind_to_any_port(address)) > 0
                                  : server_->bind_to_port(address, port);
  if (!is_bound) {
    throw Error(ErrorCode::BadFile, "cannot listen on " + std::string(address) + ":" +
                                        std::to_string(port) +
                                        ": is it in use? --port chooses another");
  }
  set_up();
  return port_;
}

void Gateway::run() {
  // stop() does nothing before the server runs. It makes its threads once it does.
  const std::function<void()> stop = [this] { server_->stop(); };
  std::optional<std::stop_callback<std::function<void()>>> interrupted;
  server_->new_task_queue = [&] {
    interrupted.emplace(session_.interrupt().token(), stop);
    return new httplib::ThreadPool(CPPHTTPLIB_THREAD_POOL_COUNT);
  };
  server_->listen_after_bind();
}

void Gateway::set_up() {
  httplib::Server& server = *server_;
  server.set_payload_max_length(jobs::max_document_bytes);
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "SAMEORIGIN"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cache-Control", "no-store"}});
  server.set_pre_routing_handler([this](const Request& request, Response& response) {
    if (is_allowed(request)) return httplib::Server::HandlerResponse::Unhandled;
    send(response, refusal_of("only this machine's own page may ask, with JSON"));
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get("/", [](const Request&, Response& response) {
    response.set_header("Content-Security-Policy",
                        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src "
                        "'self'; frame-src 'self'; base-uri 'none'; form-action 'none'");
    send(response, serve_page(), "text/html; charset=utf-8");
  });
  server.Get("/script.js", [](const Request&, Response& response) {
    send(response, serve_script(), "text/javascript; charset=utf-8");
  });
  server.Get("/style.css", [](const Request&, Response& response) {
    send(response, serve_style(), "text/css; charset=utf-8");
  });
  server.Get("/api/status", [this](const Request&, Response& response) { status(response); });
  server.Get("/api/library", [this](const Request&, Response& response) { library(response); });
  server.Get(R"(/result/\d+)",
             [this](const Request& request, Response& response) { result(request, response); });
  server.Post("/api/job",
              [this](const Request& request, Response& response) { job(request, response); });
}

}  // namespace ridgeline::command
