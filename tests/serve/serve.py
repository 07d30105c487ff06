"""serve.py RIDGELINE RIDGELINED WORK ROOT HAS_VIEWER: the gateway of `ridgeline serve`, asked like a browser and like an attacker."""

import http.client
import json
import re
import signal
import subprocess
import sys

from programs import check, empty_folder, environment_of

ridgeline, ridgelined, work, root, has_viewer = sys.argv[1:]
empty_folder(work)
environment = environment_of("serve")


class Browser:
    def __init__(self, port):
        self.port = port

    def ask(self, method, path, body=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        headers = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.request(method, path, body, headers)
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer.status, text, answer.headers

    def compute(self, job, form, **headers):
        return self.ask("POST", "/api/job?format=" + form, job, **{"Content_Type": "application/json", **headers})


def refuses_strangers(browser, job):
    own = f"http://127.0.0.1:{browser.port}"
    check(browser.ask("GET", "/", Host="ridgeline.example")[0] == 403, "another name of this machine was answered")
    check(browser.ask("GET", "/", Host=f"127.0.0.1:{browser.port + 1}")[0] == 403, "another port was answered")
    check(browser.ask("GET", "/api/library", Origin="http://evil.example")[0] == 403, "another page was answered")
    check(browser.compute(job, "json", Origin="null")[0] == 403, "a sandboxed page was answered")
    check(browser.ask("POST", "/api/job", job, Content_Type="text/plain")[0] == 403, "a form was answered")
    check(browser.compute(job, "nc", Origin=own)[0] == 200, "its own page was refused")
    check(browser.compute("[" + "0," * 16_100_000 + "0]", "json")[0] == 413, "a document beyond the limit was taken")


def computes(browser, job):
    status, text, _ = browser.compute(job, "json")
    check(status == 200 and json.loads(text)["status"] == "ok", f"{status} {text[:200]}")
    status, text, _ = browser.compute(job, "nc")
    check(status == 200 and text.startswith("%\nO"), f"{status} {text[:200]}")
    status, text, _ = browser.compute('{"job": "chamfer"}', "json")
    check(status == 422 and json.loads(text)["error"]["code"] == "bad_input", f"{status} {text[:200]}")
    status, text, _ = browser.compute("no job", "json")
    check(status == 422, f"{status} {text[:200]}")
    check(browser.ask("GET", "/result/99")[0] == 404, "a result that is not there")
    check(browser.ask("GET", "/secret")[0] == 404, "a path that is not there")
    if has_viewer == "1":
        status, text, _ = browser.compute(job, "html")
        check(status == 201, f"{status} {text[:200]}")
        status, text, headers = browser.ask("GET", json.loads(text)["result"])
        check(status == 200 and "<html" in text[:200] and "sandbox" in headers["Content-Security-Policy"], text[:200])


def start_gateway():
    return subprocess.Popen([ridgeline, "serve", "--port", "0"], env=environment, stdout=subprocess.PIPE, text=True)


def shows(browser):
    status, text, headers = browser.ask("GET", "/")
    check(status == 200 and "<title>Ridgeline" in text, text[:200])
    check("default-src 'none'" in headers["Content-Security-Policy"], "no policy")
    for path in re.findall(r'(?:src|href)="(/[^"]+)"', text):
        check(browser.ask("GET", path)[0] == 200, path)
    status, text, _ = browser.ask("GET", "/api/status", Host=f"localhost:{browser.port}")
    check(json.loads(text)["instances"][0]["name"] == "served", text)
    status, text, _ = browser.ask("GET", "/api/library")
    check({"kind": "tool", "name": "t12"}.items() <= json.loads(text)["definitions"][0].items(), text)


def ends_however_early():
    for _ in range(5):
        gateway = start_gateway()
        gateway.stdout.readline()
        gateway.send_signal(signal.SIGTERM)
        try:
            check(gateway.wait(timeout=60) == 130, "interrupted as it began: not exit status 130")
        finally:
            gateway.kill()


def main():
    with open(root + "/clients/examples/inline.json", encoding="utf-8") as file:
        job = file.read()
    with open(work + "/tool.json", "w", encoding="utf-8") as file:
        file.write('{"kind": "tool", "name": "t12", "shape": "ball", "radius": 2}')
    service = subprocess.Popen([ridgelined, "--library", work + "/library.db", "--instance", "served"], env=environment,
                               stderr=subprocess.DEVNULL)
    gateway = None
    try:
        subprocess.run([ridgeline, "library", "put", work + "/tool.json"], env=environment, check=True, stdout=subprocess.DEVNULL)
        ends_however_early()
        gateway = start_gateway()
        browser = Browser(int(re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\n", gateway.stdout.readline())[1]))
        shows(browser)
        computes(browser, job)
        refuses_strangers(browser, job)
        taken = subprocess.run([ridgeline, "serve", "--port", str(browser.port)], env=environment, capture_output=True, check=False)
        check(taken.returncode == 2 and b"--port" in taken.stderr, taken.stderr)
        gateway.send_signal(signal.SIGINT)
        check(gateway.wait(timeout=60) == 130, "interrupted: not exit status 130")
    finally:
        if gateway is not None and gateway.poll() is None:
            gateway.kill()
        service.terminate()
        service.wait()


main()
