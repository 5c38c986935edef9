/* In the page of a study two players can be played together: what this one does is told to the page
   around it, and what that says is done. */

const LINK = "flowslide-player";

/** What another page says, or null: anyone can send anything. */
function orderOf(data) {
  if (data === null || typeof data !== "object" || data.kind !== LINK) return null;
  const { time, playing, rate, lead } = data;
  const whole =
    Number.isFinite(time) &&
    RATES.includes(rate) &&
    typeof playing === "boolean" &&
    typeof lead === "boolean";
  return whole ? { time, playing, rate, lead } : null;
}

function linkPlayer(player) {
  const around = window.parent;
  if (around === window) return;
  // A file from disk has no origin that could be named. What is told is no secret.
  const tell = (began) => {
    const { time, playing, rate, start, end } = player;
    around.postMessage({ kind: LINK, time, playing, rate, start, end, began }, "*");
  };
  player.onAct = () => tell(false);
  window.addEventListener("message", (event) => {
    const order = event.source === around ? orderOf(event.data) : null;
    if (order) player.obey(order);
  });
  tell(true);
}
